// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/pipeline/ranks/joined/rank_topology.h"

namespace trismooth {

/// The components of the whole mesh: triangles connected through edges with exactly two triangles.
struct RankComponents {
  std::int64_t count = 0;
  std::int64_t reoriented_triangles = 0;  ///< listed against the majority of their component
};

/// Counts them. `reversed`: as RankTopology has it. Collective. Parts of components that go beyond a rank are joined on
/// rank 0, which hears of each part once for every rank that it meets.
RankComponents count_components(const RankTopology& topology, std::span<const std::uint8_t> reversed);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/quality/coarse_boundary.h"

namespace trismooth {

/// find_coarse_boundary() of the whole mesh, whose triangles at the boundary and at the vertices behind it rank 0 gets.
/// All is of the overlap; `local`: in the local frame. Collective: the same on all ranks.
CoarseBoundary find_coarse_boundary(const RankTopology& topology, std::span<const Point2<double>> local,
                                    std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
                                    int threads);

}  // namespace trismooth

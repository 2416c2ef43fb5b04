// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// What find_regions() finds in the whole mesh, by its rules, with Regions::of_triangle for each triangle of the rank's
/// overlap. They are numbered by values, so all ranks mean the same by a number. Collective. Throws
/// std::invalid_argument on all ranks.
Regions find_rank_regions(const PieceFiles& files, const RankTopology& topology, std::span<const std::string> names);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"

namespace trismooth {

/// Whether triangles of the whole mesh have the corners of one before them. Collective: the same on all ranks.
/// Complexity: as find_repeated_triangles(), in what the rank has.
bool has_repeated_triangles(const RankTopology& topology, Workers& workers);

}  // namespace trismooth

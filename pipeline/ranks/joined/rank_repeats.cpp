// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_repeats.h"

#include "trismooth/base/repeated_triangles.h"

namespace trismooth {

bool has_repeated_triangles(const RankTopology& topology, Workers& workers) {
  // Who has a triangle has those of the same corners, too.
  return topology.ranks().any(!find_repeated_triangles(topology.overlap().triangles, workers).empty());
}

}  // namespace trismooth

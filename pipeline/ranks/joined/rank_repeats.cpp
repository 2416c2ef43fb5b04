// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_repeats.h"

#include "trismooth/base/repeated_triangles.h"

namespace trismooth {

bool has_repeated_triangles(const RankTopology& topology, Workers& workers) {
  // Who has a triangle has those of the same corners, too.
  return topology.ranks().any(topology.overlap().elements().visit(
      [&](const auto& elements) { return !find_repeated_triangles(elements, workers).empty(); }));
}

}  // namespace trismooth

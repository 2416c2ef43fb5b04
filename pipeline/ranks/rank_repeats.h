#pragma once

#include <cstdint>

#include "trismooth/base/workers.h"
#include "trismooth/pipeline/ranks/rank_topology.h"

namespace trismooth {

/// The triangles of the whole mesh that have the corners of one before them.
struct RankRepeats {
  std::int64_t count = 0;
  std::int64_t lowest = 0;  ///< the number of the first of them in the whole mesh, where there is any
};

/// Finds them. Collective. Complexity: as find_repeated_triangles(), in what the rank has.
RankRepeats find_rank_repeats(const RankTopology& topology, Workers& workers);

}  // namespace trismooth

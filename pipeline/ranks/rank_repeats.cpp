#include "trismooth/pipeline/ranks/rank_repeats.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <mpi.h>

#include "trismooth/base/repeated_triangles.h"

namespace trismooth {

RankRepeats find_rank_repeats(const RankTopology& topology, Workers& workers) {
  const mpi::Communicator& ranks = topology.ranks();
  const mpi::Overlap& overlap = topology.overlap();
  RankRepeats found{0, std::numeric_limits<std::int64_t>::max()};
  // Who has a triangle has those of the same corners, too.
  for (const auto& [triangle, first] : find_repeated_triangles(overlap.triangles, workers)) {
    found.count += topology.counts(static_cast<std::size_t>(triangle)) ? 1 : 0;
    found.lowest = std::min(found.lowest, overlap.triangle_ids[static_cast<std::size_t>(triangle)]);
  }
  found.count = ranks.sum(found.count);
  MPI_Allreduce(MPI_IN_PLACE, &found.lowest, 1, MPI_INT64_T, MPI_MIN, ranks.handle());
  return found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ranges/vtu_range.h"
#include "trismooth/pipeline/ranks/share_reading.h"

namespace trismooth {

std::optional<MeshShare> read_vtu_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers) {
  MeshShare share;
  const bool is_read = works_on_all(ranks, [&] {
    const VtuCounts counts = count_vtu(path);
    share.document = read_vtu_range(path, range_of_rank(counts.points, ranks), range_of_rank(counts.cells, ranks),
                                    ranks.rank() == 0, FileWorkers(workers));
    return true;
  });
  return is_read ? std::optional(std::move(share)) : std::nullopt;
}

}  // namespace trismooth

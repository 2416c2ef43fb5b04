#include "trismooth/pipeline/ranks/vertex_owners.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/bisection.h"
#include "trismooth/pipeline/ranks/block_graph.h"
#include "trismooth/pipeline/ranks/metis_parts.h"

namespace trismooth {

namespace {

constexpr int blocks_a_rank = 256;

/// The rank of each block, on all ranks.
std::vector<std::int32_t> ranks_of_blocks(std::span<const std::int32_t> block_of, const ShareableMesh& mesh, int blocks,
                                          const mpi::Communicator& ranks) {
  constexpr std::size_t few_blocks_a_rank = 8;
  const BlockGraph graph = graph_of_blocks(block_of, mesh.triangles, mesh.is_copy, ranks);
  std::vector<std::int32_t> rank_of;
  agree(ranks, [&] {
    if (ranks.rank() > 0) {
      return;
    }
    const auto size = static_cast<std::size_t>(ranks.size());
    for (int block = 0; block < blocks; ++block) {
      rank_of.push_back(block / blocks_a_rank);
    }
    if (graph.blocks.size() >= few_blocks_a_rank * size && !graph.neighbours.empty()) {
      const std::vector<std::int32_t> parts = metis_parts(graph, ranks.size());
      for (std::size_t i = 0; i < parts.size(); ++i) {
        rank_of[static_cast<std::size_t>(graph.blocks[i])] = parts[i];
      }
    }
  });
  ranks.broadcast(rank_of);
  return rank_of;
}

}  // namespace

std::vector<std::int32_t> find_owners(Partition partition, const ShareableMesh& mesh, const mpi::Communicator& ranks) {
  if (partition != Partition::metis || ranks.size() == 1) {
    return bisected(mesh.points, ranks.size(), 0, ranks);
  }
  constexpr double slack = 1.0 / 16;
  const int blocks = ranks.size() * blocks_a_rank;
  std::vector<std::int32_t> owners = bisected(mesh.points, blocks, slack, ranks);
  const std::vector<std::int32_t> rank_of = ranks_of_blocks(owners, mesh, blocks, ranks);
  std::ranges::transform(owners, owners.begin(),
                         [&](std::int32_t block) { return rank_of[static_cast<std::size_t>(block)]; });
  return owners;
}

}  // namespace trismooth

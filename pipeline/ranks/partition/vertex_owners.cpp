// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/partition/vertex_owners.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/partition/bisection.h"
#include "trismooth/pipeline/ranks/partition/block_graph.h"
#include "trismooth/pipeline/ranks/partition/metis_parts.h"

namespace trismooth {

namespace {

/// Sides of elements between blocks of different parts, counted from both.
std::int64_t cut_of(const BlockGraph& graph, std::span<const std::int32_t> part_of) {
  std::int64_t cut = 0;
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    for (auto n = static_cast<std::size_t>(graph.offsets[i]); n < static_cast<std::size_t>(graph.offsets[i + 1]); ++n) {
      cut += part_of[static_cast<std::size_t>(graph.neighbours[n])] != part_of[i] ? graph.edges_between[n] : 0;
    }
  }
  return cut;
}

/// The rank of each block of the graph, by METIS where that cuts less than `bisection`, else that. On rank 0, where the
/// graph is; empty elsewhere. Collective.
std::vector<std::int32_t> ranks_of_blocks(const BlockGraph& graph, std::vector<std::int32_t> bisection,
                                          const mpi::Communicator& ranks) {
  constexpr std::size_t few_blocks_a_rank = 8;
  agree(ranks, [&] {
    const auto size = static_cast<std::size_t>(ranks.size());
    if (graph.blocks.size() < few_blocks_a_rank * size || graph.neighbours.empty()) {
      return;
    }
    std::vector<std::int32_t> found = metis_parts(graph, ranks.size());
    if (cut_of(graph, found) < cut_of(graph, bisection)) {
      bisection = std::move(found);
    }
  });
  return bisection;
}

/// Of a mesh that rank 0 has: every vertex is a block.
std::vector<std::int32_t> owners_of_whole(const ShareableMesh& mesh, const mpi::Communicator& ranks) {
  std::vector<std::int32_t> numbers(mesh.points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const BlockGraph graph = graph_of_blocks(numbers, mesh.elements, mesh.is_copy, ranks);
  return ranks_of_blocks(graph, bisected(mesh.points, ranks.size(), ranks), ranks);
}

/// Borders of parts follow those of blocks, which may be a longer way than bisection's.
std::vector<std::int32_t> owners_of_blocks(const ShareableMesh& mesh, const mpi::Communicator& ranks) {
  constexpr int most_blocks = 1 << 20;  // that rank 0 partitions, unless ranks would have too few
  const int blocks_a_rank = std::clamp(most_blocks / ranks.size(), 64, 1024);
  const int blocks = ranks.size() * blocks_a_rank;
  std::vector<std::int32_t> owners = bisected(mesh.points, blocks, ranks, {1.0 / 16, blocks_a_rank});
  const BlockGraph graph = graph_of_blocks(owners, mesh.elements, mesh.is_copy, ranks);
  std::vector<std::int32_t> rank_of_found;
  for (const std::int32_t block : graph.blocks) {
    rank_of_found.push_back(block / blocks_a_rank);
  }
  rank_of_found = ranks_of_blocks(graph, std::move(rank_of_found), ranks);
  std::vector<std::int32_t> rank_of(static_cast<std::size_t>(blocks), 0);
  for (std::size_t i = 0; i < rank_of_found.size(); ++i) {
    rank_of[static_cast<std::size_t>(graph.blocks[i])] = rank_of_found[i];
  }
  ranks.broadcast(rank_of);
  std::ranges::transform(owners, owners.begin(),
                         [&](std::int32_t block) { return rank_of[static_cast<std::size_t>(block)]; });
  return owners;
}

}  // namespace

std::vector<std::int32_t> find_owners(Partition partition, const ShareableMesh& mesh, const mpi::Communicator& ranks) {
  if (partition != Partition::metis || ranks.size() == 1) {
    return bisected(mesh.points, ranks.size(), ranks);
  }
  const bool others_have_any = ranks.any(ranks.rank() > 0 && !mesh.points.empty());
  return others_have_any ? owners_of_blocks(mesh, ranks) : owners_of_whole(mesh, ranks);
}

}  // namespace trismooth

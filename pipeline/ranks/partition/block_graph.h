// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// Blocks of a mesh's vertices, and how they hang together. Blocks without vertices are left out.
struct BlockGraph {
  std::vector<std::int32_t> blocks;         ///< numbers of those that have vertices, ascending
  std::vector<std::int64_t> weights;        ///< vertices of each
  std::vector<std::int64_t> offsets;        ///< neighbours of block i: neighbours[offsets[i] .. offsets[i + 1])
  std::vector<std::int32_t> neighbours;     ///< places in `blocks`
  std::vector<std::int64_t> edges_between;  ///< for each neighbour: sides of elements that are cut between the two
};

/// The graph, on rank 0; empty on the others. `block_of`: of each of the rank's vertices, the same on all ranks that
/// have one; a vertex that several ranks have weighs as often. Elements that `is_copy` marks have no say. Collective.
/// Complexity: n log n in the rank's elements between blocks; on rank 0 in those of all.
BlockGraph graph_of_blocks(std::span<const std::int32_t> block_of, const ElementList& elements,
                           std::span<const std::uint8_t> is_copy, const mpi::Communicator& ranks);

}  // namespace trismooth

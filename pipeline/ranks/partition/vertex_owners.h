// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/partition.h"

namespace trismooth {

/// What a rank has of a mesh that is to be shared out.
struct ShareableMesh {
  std::span<const Point2<double>> points;  ///< one a vertex; ranks agree on them
  ElementList elements;
  std::span<const std::uint8_t> is_copy;  ///< one flag an element; empty: there are none
};

/// The rank that is to move each of the rank's vertices, whoever has it, by Partition::bisect or Partition::metis.
/// METIS is serial. Where rank 0 has the whole mesh it partitions its vertices; else points are bisected into many
/// small blocks, and rank 0 partitions the graph of these: no rank has more of the mesh. Where that cuts no fewer edges
/// than bisection, or there are few blocks a rank, the mesh is bisected. Collective: throws the same on all ranks.
std::vector<std::int32_t> find_owners(Partition partition, const ShareableMesh& mesh, const mpi::Communicator& ranks);

}  // namespace trismooth

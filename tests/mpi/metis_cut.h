// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "support/random_meshes.h"

namespace mpi_tests {

#ifdef TRISMOOTH_HAS_METIS
inline constexpr bool has_metis = true;
#else
inline constexpr bool has_metis = false;
#endif

/// The rank of each vertex by METIS, which partitions the graph of the mesh's edges, alike on all ranks. A mesh of few
/// vertices a rank, or without edges, has nothing to be cut: all are rank 0's, as where there is no METIS.
std::vector<std::int32_t> metis_cut(const random_meshes::RandomMesh& mesh, std::uint64_t seed);

}  // namespace mpi_tests

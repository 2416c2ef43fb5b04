// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/metis_cut.h"

#include <cstddef>

#ifdef TRISMOOTH_HAS_METIS
#include <array>
#include <set>
#include <stdexcept>

#include <metis.h>

#include "mpi/pieces.h"
#endif

namespace mpi_tests {

std::vector<std::int32_t> metis_cut(const random_meshes::RandomMesh& mesh, [[maybe_unused]] std::uint64_t seed) {
  std::vector<std::int32_t> rank_of(static_cast<std::size_t>(mesh.mesh.vertex_count()), 0);
#ifdef TRISMOOTH_HAS_METIS
  std::vector<std::set<idx_t>> neighbours_of(rank_of.size());
  for (const trismooth::Triangle& t : mesh.mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int32_t a = t[corner];
      const std::int32_t b = t[(corner + 1) % 3];
      neighbours_of[static_cast<std::size_t>(a)].insert(b);
      neighbours_of[static_cast<std::size_t>(b)].insert(a);
    }
  }
  std::vector<idx_t> offsets{0};
  std::vector<idx_t> neighbours;
  for (const std::set<idx_t>& of_vertex : neighbours_of) {
    neighbours.insert(neighbours.end(), of_vertex.begin(), of_vertex.end());
    offsets.push_back(static_cast<idx_t>(neighbours.size()));
  }
  constexpr std::size_t few_vertices_a_rank = 8;
  if (ranks() == 1 || neighbours.empty() || rank_of.size() < few_vertices_a_rank * static_cast<std::size_t>(ranks())) {
    return rank_of;
  }
  auto vertices = static_cast<idx_t>(rank_of.size());
  idx_t parts = ranks();
  idx_t constraints = 1;
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = static_cast<idx_t>(seed % 1000);
  idx_t cut = 0;
  std::vector<idx_t> part_of(rank_of.size());
  if (METIS_PartGraphKway(&vertices, &constraints, offsets.data(), neighbours.data(), nullptr, nullptr, nullptr, &parts,
                          nullptr, nullptr, options.data(), &cut, part_of.data()) != METIS_OK) {
    throw std::runtime_error("METIS refuses the mesh");
  }
  rank_of.assign(part_of.begin(), part_of.end());
#endif
  return rank_of;
}

}  // namespace mpi_tests

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/plan.h"

#include "mpi/metis_cut.h"
#include "support/random_meshes.h"

/// A mesh cut into pieces, one a rank; every rank knows the whole and takes its own.
namespace mpi_tests {

using random_meshes::RandomMesh;

int rank();
int ranks();

/// How a mesh is cut.
enum class Cut : std::uint8_t {
  scattered,     ///< every triangle to a rank drawn for it, owners drawn among all ranks
  in_strips,     ///< along x, as partitioners do; owners as the library chooses them
  one_has_all,   ///< one rank has all, the others nothing
  one_owns_all,  ///< triangles are on all ranks, and one of these owns all vertices
  by_metis       ///< vertices by METIS, triangles where their first corner is
};
inline constexpr int cuts = has_metis ? 5 : 4;

/// What one rank has. Vertices and triangles are in an order of its own.
struct Piece {
  std::vector<trismooth::Triangle> triangles;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owners;  ///< empty: not said
  std::vector<std::uint8_t> ghosts;
  std::vector<std::int64_t> triangle_ids;
  std::vector<std::int32_t> global;  ///< of every local vertex, its number in the whole mesh
  std::vector<std::uint8_t> fixed;
  std::vector<std::int32_t> fixed_ids;
  std::vector<std::uint8_t> other_cells;
  std::vector<std::int32_t> regions;
  std::vector<double> xy;

  trismooth::mpi::LocalMesh mesh() const { return {triangles, ids, owners, ghosts, triangle_ids}; }
  trismooth::Constraints constraints() const { return {fixed, fixed_ids, other_cells, regions}; }
  /// What one number for each vertex of the whole mesh is here.
  template <class T>
  std::vector<T> local(const std::vector<T>& values) const {
    std::vector<T> found;
    for (const std::int32_t v : global) {
      found.push_back(values[static_cast<std::size_t>(v)]);
    }
    return found;
  }
};

/// This rank's piece.
Piece piece_of(const RandomMesh& mesh, Cut cut, std::uint64_t seed);

/// What this rank has where triangle t is on rank_of_triangle[t] and nowhere else: those triangles and their vertices,
/// in the order of the whole mesh; owners are not said. Isolated vertices are on rank 0.
Piece plain_piece(const RandomMesh& mesh, const std::vector<int>& rank_of_triangle);

/// Whether all ranks say the same. Collective.
bool say_the_same(const std::string& own);

/// What the lowest rank says that says something; empty where none does. Collective.
std::string said_by_any(const std::string& own);

}  // namespace mpi_tests

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/deformation.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

/// Where the vertices of a mesh are to go, from where its file has them.
struct Displacements {
  std::vector<std::array<double, 3>> of_vertex;  ///< 0 where none is given
  std::vector<std::uint8_t> is_given;            ///< a byte a vertex
  std::vector<std::string> notes;                ///< one sentence each
};

/// Whether a vertex goes where it is told.
enum class Obeys : std::uint8_t {
  never,    ///< inside: it follows
  if_told,  ///< the middle of a side of the boundary, which else goes with its side; a vertex of no cell, which stays
  always,   ///< held: without a displacement it stays
};

/// The displacements of a step, in the mesh's own file or in one of its own. `obeys`: of each vertex. Throws ReadError
/// for a file that cannot be read or has none of them, std::invalid_argument for an array that is none of
/// displacements, and for one that gives a held vertex none that is finite. Complexity: linear, but where points are
/// found by their places n log n.
Displacements find_displacements(const MeshDocument& document, const PlanarMesh& mesh, const Deformation& deformation,
                                 std::size_t step, std::span<const Obeys> obeys, int threads);

}  // namespace trismooth

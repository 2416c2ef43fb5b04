// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/ranks/shared_numbers.h"

namespace trismooth {

/// A piece of a mesh that a rank has read.
struct Piece {
  std::size_t number = 0;  ///< among those of the parallel file, from 0
  std::filesystem::path path;
  MeshDocument document;
  PlanarMesh mesh;                        ///< in the plane of x and y
  std::vector<std::uint8_t> ghost_cells;  ///< one flag a cell: 1 where another piece has it
  SharedNumbers ids;                      ///< one a point: its number in the whole mesh
  std::vector<std::int32_t> vertices;     ///< one a point: its number among those of the rank
  AddedArrays added;                      ///< that are written beside those of the document

  // Of pieces that one file was shared out in; else empty.
  SharedNumbers cell_ids;                  ///< one a cell: its number in the file, ascending
  SharedNumbers triangle_ids;              ///< one an element of the mesh: its number in the file, ascending
  std::vector<std::uint8_t> held_by_sets;  ///< one a point, as MeshShare has it
  std::vector<std::uint8_t> implied_by;    ///< one a point, as MeshShare has it

  bool is_ghost(std::size_t triangle) const { return ghost_cells[static_cast<std::size_t>(mesh.cells[triangle])] != 0; }
};

/// The cells of a piece that no other piece has.
struct OwnCells {
  std::int64_t triangles = 0;  ///< and quadrilaterals that are smoothed; those of strips count one by one
  std::int64_t cells = 0;
  std::int64_t others = 0;           ///< that are no elements
  std::int64_t lines = 0;            ///< those of them that are lines or curves
  RepeatingCells repeating;          ///< those of them that repeat a vertex, by their numbers in the piece
  std::int64_t held_quads = 0;       ///< quadrilaterals among the others
  std::int64_t collapsed_quads = 0;  ///< CellTriangle::is_quad
};

/// Counts the piece's. Local. Complexity: linear.
OwnCells count_own_cells(const Piece& piece);

/// The number of a cell of the piece in the one file that pieces are of, or else among those of all pieces, copies left
/// out, where `before` come before the piece's. Local. Complexity: linear in the cells before it.
std::int64_t number_of_cell(const Piece& piece, std::int64_t cell, std::int64_t before);

/// Whether it has any points or cells. Local.
bool holds_something(const Piece& piece);

/// The cell array that says which cells are copies.
inline constexpr std::string_view ghost_flags_name = "vtkGhostType";

/// One flag a cell, 1 where the array of that name tells it to be a copy. Local.
std::vector<std::uint8_t> ghost_cells_of(const MeshDocument& document);

}  // namespace trismooth

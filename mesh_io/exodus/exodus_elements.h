// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trismooth {

/// An element of Exodus II as a cell.
struct ExodusShape {
  std::uint8_t type = 0;                 ///< its cell_type
  std::size_t nodes = 0;                 ///< 0: not known
  std::string_view name;                 ///< that is written
  const std::uint8_t* places = nullptr;  ///< of a cell's nodes in the file; null: the same

  /// The place in the file of the cell's node k, and in the cell of the file's: these orders exchange nodes in pairs.
  std::size_t place(std::size_t k) const { return places == nullptr ? k : places[k]; }
};

/// The element of that type (as a file has it: "TRI3", "quad", "SHELL4", "BAR2") and that many nodes in a mesh of so
/// many axes; one without nodes where it is not known.
const ExodusShape& exodus_shape(std::string_view type, std::size_t nodes, std::size_t axes);

/// The element that cells of that type are written as; one without nodes where there is none.
const ExodusShape& exodus_shape_of_cell(std::uint8_t type);

/// Corners, and so many sides, of a face of that cell_type with so many vertices; 0 where it is none.
std::size_t exodus_corners(std::uint8_t type, std::size_t vertices);

/// Whether elements of that type begin their sides with their two faces: shells do, and triangles in space.
bool begins_with_faces(std::string_view type, std::size_t axes);

}  // namespace trismooth

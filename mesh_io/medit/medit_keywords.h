// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace trismooth {

/// What a section of a Medit file is to a mesh.
enum class MeditRole : std::uint8_t {
  version,
  dimension,
  precision,  ///< bits of the coordinates, in binary files, whatever the version says
  vertices,
  cells,
  vertex_set,  ///< vertices that it lists
  cell_set,    ///< the vertices of cells that it lists
  end,
  unsupported,  ///< cells that cannot be read
  other         ///< no part of a mesh
};

/// A keyword of Medit files, as the libMeshb library numbers them.
struct MeditKeyword {
  std::string_view name;
  std::int32_t code;  ///< in binary files
  MeditRole role;
  std::uint8_t cell_type = 0;  ///< of `cells`, and of the cells of a `cell_set`
  std::size_t vertices = 0;    ///< of a cell
  bool is_written = false;     ///< cells whose vertices are in VTK's order for sure
};

/// Codes that readers and writers name.
namespace medit_code {
inline constexpr std::int32_t dimension = 3;
inline constexpr std::int32_t vertices = 4;
inline constexpr std::int32_t corners = 13;
inline constexpr std::int32_t required_vertices = 15;
inline constexpr std::int32_t end = 54;
}  // namespace medit_code

/// All that are known, in no order.
std::span<const MeditKeyword> medit_keywords();

/// The keyword of that name, in any case of letters; null for those that are not known.
const MeditKeyword* find_medit_keyword(std::string_view name);

/// The type of cell whose numbers a set of cells takes where the file has none of its own type.
std::uint8_t quadratic_medit_type(std::uint8_t type);

/// The keyword of that code; null for those that are not known.
const MeditKeyword* find_medit_keyword(std::int32_t code);

}  // namespace trismooth

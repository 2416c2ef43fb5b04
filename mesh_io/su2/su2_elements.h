// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/base/cell_list.h"

namespace trismooth {

/// The sections of an SU2 mesh whose rows are cells.
enum class Su2Section : std::uint8_t { elements, marker };

/// The points that a row of a cell has in that section of a mesh of that dimension (NDIME), by the type that it begins
/// with, which is VTK's; 0 for types that do not belong there. Faces alone are smoothed: solids have no place anywhere.
/// Halo points of meshes that were cut for parallel runs are markers of vertices.
constexpr std::size_t su2_points_of(Su2Section section, int dimension, std::int64_t type) {
  const bool is_marker = section == Su2Section::marker;
  switch (type) {
    case cell_type::vertex:
      return is_marker ? 1 : 0;
    case cell_type::line:
      return 2;
    case cell_type::triangle:
      return is_marker && dimension == 2 ? 0 : 3;
    case cell_type::quad:
      return is_marker && dimension == 2 ? 0 : 4;
    default:
      return 0;
  }
}

/// The solids of SU2, for messages; empty for other types.
constexpr std::string_view su2_solid_name(std::int64_t type) {
  switch (type) {
    case cell_type::tetrahedron:
      return "tetrahedron";
    case cell_type::hexahedron:
      return "hexahedron";
    case cell_type::wedge:
      return "prism";
    case cell_type::pyramid:
      return "pyramid";
    default:
      return {};
  }
}

}  // namespace trismooth

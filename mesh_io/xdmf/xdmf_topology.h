// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/xdmf/xdmf_items.h"

namespace trismooth {

/// What XDMF calls a type of cells.
struct XdmfCellType {
  std::array<std::string_view, 2> names;  ///< the one that is written, and another or an empty one
  std::int64_t number = 0;                ///< in a mixed topology
  std::size_t vertices = 0;               ///< 0: any number; in a mixed topology it stands in front of the vertices
  std::uint8_t type = 0;
};

/// Types of cells with any number of vertices come first.
inline constexpr auto xdmf_cell_types = std::to_array<XdmfCellType>({
    {{"Polyvertex", ""}, 1, 0, cell_type::vertex},
    {{"Polyline", ""}, 2, 0, cell_type::line},
    {{"Polygon", ""}, 3, 0, cell_type::polygon},
    {{"Triangle", ""}, 4, 3, cell_type::triangle},
    {{"Quadrilateral", "Quad"}, 5, 4, cell_type::quad},
    {{"Tetrahedron", ""}, 6, 4, cell_type::tetrahedron},
    {{"Pyramid", ""}, 7, 5, cell_type::pyramid},
    {{"Wedge", ""}, 8, 6, cell_type::wedge},
    {{"Hexahedron", ""}, 9, 8, cell_type::hexahedron},
    {{"Edge_3", ""}, 0x22, 3, cell_type::quadratic_edge},
    {{"Quadrilateral_9", "Quad_9"}, 0x23, 9, cell_type::biquadratic_quad},
    {{"Triangle_6", "Tri_6"}, 0x24, 6, cell_type::quadratic_triangle},
    {{"Quadrilateral_8", "Quad_8"}, 0x25, 8, cell_type::quadratic_quad},
    {{"Tetrahedron_10", "Tet_10"}, 0x26, 10, cell_type::quadratic_tetrahedron},
    {{"Pyramid_13", ""}, 0x27, 13, cell_type::quadratic_pyramid},
    {{"Wedge_15", ""}, 0x28, 15, cell_type::quadratic_wedge},
    {{"Wedge_18", ""}, 0x29, 18, cell_type::biquadratic_quadratic_wedge},
    {{"Hexahedron_20", "Hex_20"}, 0x30, 20, cell_type::quadratic_hexahedron},
    {{"Hexahedron_27", "Hex_27"}, 0x32, 27, cell_type::triquadratic_hexahedron},
});

/// The one of those that cells of that type are written as, or nullptr.
const XdmfCellType* xdmf_cell_type(std::uint8_t type);

/// The cells of a <Topology> over so many points, counted from 0. Throws ReadError.
CellList read_xdmf_cells(XdmfItems& items, const XmlElement& topology, std::size_t points);

}  // namespace trismooth

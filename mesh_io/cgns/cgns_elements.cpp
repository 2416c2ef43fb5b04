// SPDX-License-Identifier: BSD-3-Clause
// Elements as the SIDS of CGNS number them: of curved wedges and hexahedra the
// middles of upright sides come before those of the top.
#include "trismooth/mesh_io/cgns/cgns_elements.h"

#include <algorithm>
#include <array>

#include "trismooth/base/cell_list.h"

namespace trismooth {

namespace {

constexpr std::array<std::uint8_t, 15> quadratic_wedge_nodes{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
constexpr std::array<std::uint8_t, 20> quadratic_hexahedron_nodes{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                                  10, 11, 16, 17, 18, 19, 12, 13, 14, 15};

// Of those with nodes inside of solids the nodes alone are kept.
constexpr auto all_elements = std::to_array<CgnsElement>({
    {2, cell_type::vertex, 1},
    {3, cell_type::line, 2},
    {4, cell_type::quadratic_edge, 3},
    {24, cell_type::cubic_line, 4},
    {5, cell_type::triangle, 3},
    {7, cell_type::quad, 4},
    {6, cell_type::quadratic_triangle, 6},
    {8, cell_type::quadratic_quad, 8},
    {9, cell_type::biquadratic_quad, 9},
    {10, cell_type::tetrahedron, 4},
    {12, cell_type::pyramid, 5},
    {14, cell_type::wedge, 6},
    {17, cell_type::hexahedron, 8},
    {11, cell_type::quadratic_tetrahedron, 10},
    {21, cell_type::quadratic_pyramid, 13},
    {15, cell_type::quadratic_wedge, 15, quadratic_wedge_nodes.data()},
    {18, cell_type::quadratic_hexahedron, 20, quadratic_hexahedron_nodes.data()},
    {13, cell_type::convex_point_set, 14, nullptr, false},
    {16, cell_type::convex_point_set, 18, nullptr, false},
    {19, cell_type::convex_point_set, 27, nullptr, false},
});

}  // namespace

std::span<const CgnsElement> cgns_elements() {
  return all_elements;
}

const CgnsElement* find_cgns_element(std::int64_t number) {
  const auto* const found = std::ranges::find(all_elements, number, &CgnsElement::number);
  return found == all_elements.end() ? nullptr : found;
}

const CgnsElement* cgns_element_of_cell(std::uint8_t type, std::size_t vertices) {
  const auto* const found = std::ranges::find_if(all_elements, [type, vertices](const CgnsElement& element) {
    return element.is_written && element.type == type && element.nodes == vertices;
  });
  return found == all_elements.end() ? nullptr : found;
}

}  // namespace trismooth

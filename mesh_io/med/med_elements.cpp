// SPDX-License-Identifier: BSD-3-Clause
// Elements as MED's reference numbers them. Of solids, MED looks at the other side of the first face.
#include "trismooth/mesh_io/med/med_elements.h"

#include <algorithm>
#include <array>

#include "trismooth/base/cell_list.h"

namespace trismooth {

namespace {

constexpr std::uint8_t biquadratic_triangle = 34;

constexpr std::array<std::uint8_t, 4> tetrahedron_places{0, 2, 1, 3};
constexpr std::array<std::uint8_t, 10> quadratic_tetrahedron_places{0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<std::uint8_t, 5> pyramid_places{0, 3, 2, 1, 4};
constexpr std::array<std::uint8_t, 13> quadratic_pyramid_places{0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};
constexpr std::array<std::uint8_t, 6> wedge_places{0, 2, 1, 3, 5, 4};
constexpr std::array<std::uint8_t, 15> quadratic_wedge_places{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13};
constexpr std::array<std::uint8_t, 8> hexahedron_places{0, 3, 2, 1, 4, 7, 6, 5};
constexpr std::array<std::uint8_t, 20> quadratic_hexahedron_places{0, 3, 2,  1,  4,  7,  6,  5,  11, 10,
                                                                   9, 8, 15, 14, 13, 12, 16, 19, 18, 17};

// Of the last ones, which no other format here has, the nodes alone are kept.
constexpr auto elements = std::to_array<MedElement>({
    {"PO1", 1, cell_type::vertex, 1},
    {"SE2", 102, cell_type::line, 2},
    {"SE3", 103, cell_type::quadratic_edge, 3},
    {"SE4", 104, cell_type::cubic_line, 4},
    {"TR3", 203, cell_type::triangle, 3},
    {"QU4", 204, cell_type::quad, 4},
    {"TR6", 206, cell_type::quadratic_triangle, 6},
    {"TR7", 207, biquadratic_triangle, 7},
    {"QU8", 208, cell_type::quadratic_quad, 8},
    {"QU9", 209, cell_type::biquadratic_quad, 9},
    {"TE4", 304, cell_type::tetrahedron, 4, tetrahedron_places.data()},
    {"PY5", 305, cell_type::pyramid, 5, pyramid_places.data()},
    {"PE6", 306, cell_type::wedge, 6, wedge_places.data()},
    {"HE8", 308, cell_type::hexahedron, 8, hexahedron_places.data()},
    {"T10", 310, cell_type::quadratic_tetrahedron, 10, quadratic_tetrahedron_places.data()},
    {"P13", 313, cell_type::quadratic_pyramid, 13, quadratic_pyramid_places.data()},
    {"P15", 315, cell_type::quadratic_wedge, 15, quadratic_wedge_places.data()},
    {"H20", 320, cell_type::quadratic_hexahedron, 20, quadratic_hexahedron_places.data()},
    {"OCT", 312, cell_type::convex_point_set, 12, nullptr, false},
    {"P18", 318, cell_type::convex_point_set, 18, nullptr, false},
    {"H27", 327, cell_type::convex_point_set, 27, nullptr, false},
    {"POG", 400, cell_type::polygon, 0},
});

}  // namespace

std::span<const MedElement> med_elements() {
  return elements;
}

const MedElement* find_med_element(std::string_view name) {
  const auto* const found = std::ranges::find(elements, name, &MedElement::name);
  return found == elements.end() ? nullptr : found;
}

const MedElement* med_element_of_cell(std::uint8_t type, std::size_t vertices) {
  const auto* const found = std::ranges::find_if(elements, [type, vertices](const MedElement& element) {
    const bool has_size = element.nodes == vertices || (element.nodes == 0 && vertices >= 3);
    return element.is_written && element.type == type && has_size;
  });
  return found == elements.end() ? nullptr : found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_elements.h"

#include <algorithm>
#include <array>

namespace trismooth {

namespace {

constexpr NastranShape nastran_node{cell_type::vertex, 1, 1};
constexpr NastranShape nastran_line{cell_type::line, 2, 2};
constexpr NastranShape nastran_grounded_line{cell_type::line, 1, 2};
constexpr NastranShape nastran_curve{cell_type::quadratic_edge, 2, 3};
constexpr NastranShape nastran_triangle{cell_type::triangle, 3, 3};
constexpr NastranShape nastran_curved_triangle{cell_type::quadratic_triangle, 3, 6};
constexpr NastranShape nastran_alternate_triangle{cell_type::quadratic_triangle, 3, 6, true};
constexpr NastranShape nastran_quad{cell_type::quad, 4, 4};
constexpr NastranShape nastran_curved_quad{cell_type::quadratic_quad, 4, 8};
constexpr NastranShape nastran_full_quad{cell_type::biquadratic_quad, 4, 9};
constexpr NastranShape nastran_tetrahedron{cell_type::tetrahedron, 4, 4};
constexpr NastranShape nastran_curved_tetrahedron{cell_type::quadratic_tetrahedron, 4, 10};
constexpr NastranShape nastran_pyramid{cell_type::pyramid, 5, 5};
constexpr NastranShape nastran_curved_pyramid{cell_type::quadratic_pyramid, 5, 13};
constexpr NastranShape nastran_wedge{cell_type::wedge, 6, 6};
constexpr NastranShape nastran_curved_wedge{cell_type::quadratic_wedge, 6, 15};
constexpr NastranShape nastran_hexahedron{cell_type::hexahedron, 8, 8};
constexpr NastranShape nastran_curved_hexahedron{cell_type::quadratic_hexahedron, 8, 20};

/// Of the cards for one type of cells, the first is written.
constexpr auto nastran_elements = std::to_array<NastranElement>({
    {"CTRIA3", nastran_triangle},
    {"CTRIA6", nastran_triangle, nastran_curved_triangle},
    {"CQUAD4", nastran_quad},
    {"CQUAD8", nastran_quad, nastran_curved_quad},
    {"CROD", nastran_line},
    {"CBEAM3", nastran_line, nastran_curve},
    {"CTETRA", nastran_tetrahedron, nastran_curved_tetrahedron},
    {"CPYRAM", nastran_pyramid, nastran_curved_pyramid},
    {"CPENTA", nastran_wedge, nastran_curved_wedge},
    {"CHEXA", nastran_hexahedron, nastran_curved_hexahedron},
    {"CQUAD", nastran_quad, nastran_full_quad},
    {"CQUAD9", nastran_quad, nastran_full_quad},  // as Gmsh writes it
    {"CTRIAR", nastran_triangle},
    {"CQUADR", nastran_quad},
    {"CSHEAR", nastran_quad},
    {"CTRIAX", nastran_triangle, nastran_curved_triangle},
    {"CTRIAX6", nastran_triangle, nastran_alternate_triangle},
    {"CTRAX3", nastran_triangle},
    {"CTRAX6", nastran_triangle, nastran_curved_triangle},
    {"CQUADX", nastran_quad, nastran_full_quad},
    {"CQUADX4", nastran_quad},
    {"CQUADX8", nastran_quad, nastran_curved_quad},
    {"CPLSTN3", nastran_triangle},
    {"CPLSTN4", nastran_quad},
    {"CPLSTN6", nastran_triangle, nastran_curved_triangle},
    {"CPLSTN8", nastran_quad, nastran_curved_quad},
    {"CPLSTS3", nastran_triangle},
    {"CPLSTS4", nastran_quad},
    {"CPLSTS6", nastran_triangle, nastran_curved_triangle},
    {"CPLSTS8", nastran_quad, nastran_curved_quad},
    {"CBAR", nastran_line},
    {"CBEAM", nastran_line},
    {"CBEND", nastran_line},
    {"CTUBE", nastran_line},
    {"CVISC", nastran_line},
    {"CGAP", nastran_line},
    {"CBUSH", nastran_node, nastran_grounded_line},
    {"CBUSH1D", nastran_node, nastran_grounded_line},
    {"CONROD", nastran_line, {}, false},
    {"PLOTEL", nastran_line, {}, false},
    {"CONM1", nastran_node, {}, false},
    {"CONM2", nastran_node, {}, false},
    {"CPYRA", nastran_pyramid, nastran_curved_pyramid},
    {"CTRIA3FD", nastran_triangle, nastran_curved_triangle},
    {"CTRIA6FD", nastran_triangle, nastran_curved_triangle},
    {"CQUAD4FD", nastran_quad, nastran_full_quad},
    {"CQUAD9FD", nastran_quad, nastran_full_quad},
});

}  // namespace

const NastranElement* find_nastran_element(std::string_view name) {
  const auto* const found = std::ranges::find(nastran_elements, name, &NastranElement::name);
  return found == nastran_elements.end() ? nullptr : found;
}

const NastranElement* nastran_element_of_cell(std::uint8_t type) {
  // A vertex would need more than its card says.
  const auto* const found = std::ranges::find_if(nastran_elements, [type](const NastranElement& element) {
    return element.has_property && type != cell_type::vertex &&
           (element.plain.type == type || element.curved.type == type);
  });
  return found == nastran_elements.end() ? nullptr : found;
}

std::size_t NastranShape::place(std::size_t i) const {
  if (is_alternate) {
    return i < corners ? 2 * i : 2 * (i - corners) + 1;
  }
  // On cards, the middles of the upright edges stand before those of the upper face.
  if (type == cell_type::quadratic_wedge && i >= 9) {
    return i < 12 ? i + 3 : i - 3;
  }
  if (type == cell_type::quadratic_hexahedron && i >= 12) {
    return i < 16 ? i + 4 : i - 4;
  }
  return i;
}

}  // namespace trismooth

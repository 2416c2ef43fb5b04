#include "trismooth/mesh_io/nastran/nastran_elements.h"

#include <algorithm>
#include <array>

namespace trismooth {

namespace {

constexpr NastranShape one_node{cell_type::vertex, 1, 1};
constexpr NastranShape line_shape{cell_type::line, 2, 2};
constexpr NastranShape grounded_line{cell_type::line, 1, 2};
constexpr NastranShape curve{cell_type::quadratic_edge, 2, 3};
constexpr NastranShape triangle{cell_type::triangle, 3, 3};
constexpr NastranShape curved_triangle{cell_type::quadratic_triangle, 3, 6};
constexpr NastranShape alternate_triangle{cell_type::quadratic_triangle, 3, 6, true};
constexpr NastranShape quad{cell_type::quad, 4, 4};
constexpr NastranShape curved_quad{cell_type::quadratic_quad, 4, 8};
constexpr NastranShape full_quad{cell_type::biquadratic_quad, 4, 9};
constexpr NastranShape tetrahedron{cell_type::tetrahedron, 4, 4};
constexpr NastranShape curved_tetrahedron{cell_type::quadratic_tetrahedron, 4, 10};
constexpr NastranShape pyramid{cell_type::pyramid, 5, 5};
constexpr NastranShape curved_pyramid{cell_type::quadratic_pyramid, 5, 13};
constexpr NastranShape wedge{cell_type::wedge, 6, 6};
constexpr NastranShape curved_wedge{cell_type::quadratic_wedge, 6, 15};
constexpr NastranShape hexahedron{cell_type::hexahedron, 8, 8};
constexpr NastranShape curved_hexahedron{cell_type::quadratic_hexahedron, 8, 20};

/// Of the cards for one type of cells, the first is written.
constexpr auto elements = std::to_array<NastranElement>({
    {"CTRIA3", triangle},
    {"CTRIA6", triangle, curved_triangle},
    {"CQUAD4", quad},
    {"CQUAD8", quad, curved_quad},
    {"CROD", line_shape},
    {"CBEAM3", line_shape, curve},
    {"CTETRA", tetrahedron, curved_tetrahedron},
    {"CPYRAM", pyramid, curved_pyramid},
    {"CPENTA", wedge, curved_wedge},
    {"CHEXA", hexahedron, curved_hexahedron},
    {"CQUAD", quad, full_quad},
    {"CTRIAR", triangle},
    {"CQUADR", quad},
    {"CSHEAR", quad},
    {"CTRIAX", triangle, curved_triangle},
    {"CTRIAX6", triangle, alternate_triangle},
    {"CTRAX3", triangle},
    {"CTRAX6", triangle, curved_triangle},
    {"CQUADX", quad, full_quad},
    {"CQUADX4", quad},
    {"CQUADX8", quad, curved_quad},
    {"CPLSTN3", triangle},
    {"CPLSTN4", quad},
    {"CPLSTN6", triangle, curved_triangle},
    {"CPLSTN8", quad, curved_quad},
    {"CPLSTS3", triangle},
    {"CPLSTS4", quad},
    {"CPLSTS6", triangle, curved_triangle},
    {"CPLSTS8", quad, curved_quad},
    {"CBAR", line_shape},
    {"CBEAM", line_shape},
    {"CBEND", line_shape},
    {"CTUBE", line_shape},
    {"CVISC", line_shape},
    {"CGAP", line_shape},
    {"CBUSH", one_node, grounded_line},
    {"CBUSH1D", one_node, grounded_line},
    {"CONROD", line_shape, {}, false},
    {"PLOTEL", line_shape, {}, false},
    {"CONM1", one_node, {}, false},
    {"CONM2", one_node, {}, false},
    {"CPYRA", pyramid, curved_pyramid},
    {"CTRIA3FD", triangle, curved_triangle},
    {"CTRIA6FD", triangle, curved_triangle},
    {"CQUAD4FD", quad, full_quad},
    {"CQUAD9FD", quad, full_quad},
});

}  // namespace

const NastranElement* find_nastran_element(std::string_view name) {
  const auto* const found = std::ranges::find(elements, name, &NastranElement::name);
  return found == elements.end() ? nullptr : found;
}

const NastranElement* nastran_element_of_cell(std::uint8_t type) {
  // A vertex would need more than its card says.
  const auto* const found = std::ranges::find_if(elements, [type](const NastranElement& element) {
    return element.has_property && type != cell_type::vertex &&
           (element.plain.type == type || element.curved.type == type);
  });
  return found == elements.end() ? nullptr : found;
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

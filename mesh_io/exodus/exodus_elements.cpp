// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/exodus/exodus_elements.h"

#include <algorithm>
#include <array>
#include <string>

#include "trismooth/base/cell_list.h"
#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

enum class ExodusFamily : std::uint8_t {
  none,
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  wedge,
  hexahedron
};

// Behind the middles of the lower face come those between the faces, then those of the upper one.
constexpr std::array<std::uint8_t, 15> wedge_places{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
constexpr std::array<std::uint8_t, 20> hexahedron_places{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                         10, 11, 16, 17, 18, 19, 12, 13, 14, 15};

struct FamilyShape {
  ExodusFamily family;
  ExodusShape shape;
};

constexpr auto shapes = std::to_array<FamilyShape>({
    {ExodusFamily::triangle, {cell_type::triangle, 3, "TRI3"}},
    {ExodusFamily::quadrilateral, {cell_type::quad, 4, "QUAD4"}},
    {ExodusFamily::triangle, {cell_type::quadratic_triangle, 6, "TRI6"}},
    {ExodusFamily::quadrilateral, {cell_type::quadratic_quad, 8, "QUAD8"}},
    {ExodusFamily::quadrilateral, {cell_type::biquadratic_quad, 9, "QUAD9"}},
    {ExodusFamily::line, {cell_type::line, 2, "BAR2"}},
    {ExodusFamily::line, {cell_type::quadratic_edge, 3, "BAR3"}},
    {ExodusFamily::point, {cell_type::vertex, 1, "SPHERE"}},
    {ExodusFamily::tetrahedron, {cell_type::tetrahedron, 4, "TETRA4"}},
    {ExodusFamily::tetrahedron, {cell_type::quadratic_tetrahedron, 10, "TETRA10"}},
    {ExodusFamily::pyramid, {cell_type::pyramid, 5, "PYRAMID5"}},
    {ExodusFamily::wedge, {cell_type::wedge, 6, "WEDGE6"}},
    {ExodusFamily::wedge, {cell_type::quadratic_wedge, 15, "WEDGE15", wedge_places.data()}},
    {ExodusFamily::hexahedron, {cell_type::hexahedron, 8, "HEX8"}},
    {ExodusFamily::hexahedron, {cell_type::quadratic_hexahedron, 20, "HEX20", hexahedron_places.data()}},
});

constexpr ExodusShape no_shape{};

struct Beginning {
  std::string_view text;
  ExodusFamily family;
};

constexpr auto type_beginnings = std::to_array<Beginning>({{"TRI", ExodusFamily::triangle},
                                                           {"QUAD", ExodusFamily::quadrilateral},
                                                           {"BAR", ExodusFamily::line},
                                                           {"BEAM", ExodusFamily::line},
                                                           {"TRUSS", ExodusFamily::line},
                                                           {"EDGE", ExodusFamily::line},
                                                           {"ROD", ExodusFamily::line},
                                                           {"LINE", ExodusFamily::line},
                                                           {"SPHERE", ExodusFamily::point},
                                                           {"CIRCLE", ExodusFamily::point},
                                                           {"POINT", ExodusFamily::point},
                                                           {"TET", ExodusFamily::tetrahedron},
                                                           {"PYR", ExodusFamily::pyramid},
                                                           {"WEDGE", ExodusFamily::wedge},
                                                           {"HEX", ExodusFamily::hexahedron}});

/// A shell in the plane is a line.
ExodusFamily family_of_shell(std::size_t nodes, std::size_t axes) {
  if (nodes == 2 || (nodes == 3 && axes == 2)) {
    return ExodusFamily::line;
  }
  return nodes == 3 || nodes == 6 ? ExodusFamily::triangle : ExodusFamily::quadrilateral;
}

ExodusFamily family_of(std::string_view type, std::size_t nodes, std::size_t axes) {
  const std::string name = upper_case(type);
  if (name.starts_with("SHELL")) {
    return family_of_shell(nodes, axes);
  }
  const auto* const found = std::ranges::find_if(
      type_beginnings, [&name](const Beginning& beginning) { return name.starts_with(beginning.text); });
  return found == type_beginnings.end() ? ExodusFamily::none : found->family;
}

}  // namespace

const ExodusShape& exodus_shape(std::string_view type, std::size_t nodes, std::size_t axes) {
  const ExodusFamily family = family_of(type, nodes, axes);
  const auto* const found = std::ranges::find_if(
      shapes, [=](const FamilyShape& known) { return known.family == family && known.shape.nodes == nodes; });
  return found == shapes.end() ? no_shape : found->shape;
}

const ExodusShape& exodus_shape_of_cell(std::uint8_t type) {
  const auto* const found =
      std::ranges::find_if(shapes, [type](const FamilyShape& known) { return known.shape.type == type; });
  return found == shapes.end() ? no_shape : found->shape;
}

std::size_t exodus_corners(std::uint8_t type, std::size_t vertices) {
  switch (type) {
    case cell_type::triangle:
    case cell_type::quadratic_triangle:
      return 3;
    case cell_type::quad:
    case cell_type::quadratic_quad:
    case cell_type::biquadratic_quad:
      return 4;
    default:
      return type == cell_type::polygon ? vertices : 0;
  }
}

bool begins_with_faces(std::string_view type, std::size_t axes) {
  const std::string name = upper_case(type);
  return axes == 3 && (name.starts_with("SHELL") || name.starts_with("TRI"));
}

}  // namespace trismooth

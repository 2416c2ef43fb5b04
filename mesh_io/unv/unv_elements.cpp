// SPDX-License-Identifier: BSD-3-Clause
// Elements of data set 2412 by their FE descriptors, as the reference of the format lists them; nodes of curved ones go
// around each face, corners and middles in turn.
#include "trismooth/mesh_io/unv/unv_elements.h"

#include <algorithm>
#include <array>

#include "trismooth/base/cell_list.h"

namespace trismooth {

namespace {

enum class UnvFamily : std::uint8_t { none, line, triangle, quadrilateral, tetrahedron, wedge, hexahedron };

constexpr std::array<std::uint8_t, 3> edge_places{0, 2, 1};
constexpr std::array<std::uint8_t, 6> triangle_places{0, 2, 4, 1, 3, 5};
constexpr std::array<std::uint8_t, 8> quadrilateral_places{0, 2, 4, 6, 1, 3, 5, 7};
constexpr std::array<std::uint8_t, 10> tetrahedron_places{0, 2, 4, 9, 1, 3, 5, 6, 7, 8};
constexpr std::array<std::uint8_t, 15> wedge_places{0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8};
constexpr std::array<std::uint8_t, 20> hexahedron_places{0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                                         5, 7, 13, 15, 17, 19, 8,  9,  10, 11};

struct UnvFamilyShape {
  UnvFamily family;
  UnvShape shape;
};

/// Faces are written as thin shells, which is what other programs write them as, too.
constexpr auto unv_shapes = std::to_array<UnvFamilyShape>({
    {UnvFamily::line, {cell_type::line, 2, 21}},
    {UnvFamily::line, {cell_type::quadratic_edge, 3, 24, edge_places.data()}},
    {UnvFamily::triangle, {cell_type::triangle, 3, 91}},
    {UnvFamily::triangle, {cell_type::quadratic_triangle, 6, 92, triangle_places.data()}},
    {UnvFamily::quadrilateral, {cell_type::quad, 4, 94}},
    {UnvFamily::quadrilateral, {cell_type::quadratic_quad, 8, 95, quadrilateral_places.data()}},
    // No element of the format: Gmsh writes it corners first, and reads these alone.
    {UnvFamily::quadrilateral, {cell_type::biquadratic_quad, 9, 94}},
    {UnvFamily::tetrahedron, {cell_type::tetrahedron, 4, 111}},
    {UnvFamily::tetrahedron, {cell_type::quadratic_tetrahedron, 10, 118, tetrahedron_places.data()}},
    {UnvFamily::wedge, {cell_type::wedge, 6, 112}},
    {UnvFamily::wedge, {cell_type::quadratic_wedge, 15, 113, wedge_places.data()}},
    {UnvFamily::hexahedron, {cell_type::hexahedron, 8, 115}},
    {UnvFamily::hexahedron, {cell_type::quadratic_hexahedron, 20, 116, hexahedron_places.data()}},
});

constexpr UnvShape no_unv_shape{};

UnvFamily unv_family_of(std::int64_t descriptor) {
  switch (descriptor) {
    case 11:  // rod
    case 21:  // linear, tapered, curved, parabolic beam
    case 22:
    case 23:
    case 24:
    case 31:  // straight and curved pipe
    case 32:
    case 171:  // linear and parabolic axisymmetric shell
    case 172:
      return UnvFamily::line;
    case 41:  // plane stress
    case 42:
    case 51:  // plane strain
    case 52:
    case 61:  // plate
    case 62:
    case 72:  // membrane
    case 74:
    case 81:  // axisymmetric solid
    case 82:
    case 91:  // thin shell
    case 92:
      return UnvFamily::triangle;
    case 44:
    case 45:
    case 54:
    case 55:
    case 64:
    case 65:
    case 71:
    case 75:
    case 84:
    case 85:
    case 94:
    case 95:
      return UnvFamily::quadrilateral;
    case 111:
    case 118:
      return UnvFamily::tetrahedron;
    case 101:  // thick shell
    case 102:
    case 112:
    case 113:
      return UnvFamily::wedge;
    case 104:
    case 105:
    case 115:
    case 116:
      return UnvFamily::hexahedron;
    default:
      return UnvFamily::none;
  }
}

}  // namespace

const UnvShape& unv_shape(std::int64_t descriptor, std::int64_t nodes) {
  const UnvFamily family = unv_family_of(descriptor);
  const auto* const found = std::ranges::find_if(unv_shapes, [=](const UnvFamilyShape& known) {
    return known.family == family && static_cast<std::int64_t>(known.shape.nodes) == nodes;
  });
  return found == unv_shapes.end() ? no_unv_shape : found->shape;
}

const UnvShape& unv_shape_of_cell(std::uint8_t type) {
  const auto* const found =
      std::ranges::find_if(unv_shapes, [type](const UnvFamilyShape& known) { return known.shape.type == type; });
  return found == unv_shapes.end() ? no_unv_shape : found->shape;
}

bool is_unv_beam(std::int64_t descriptor) {
  return descriptor == 11 || (descriptor >= 21 && descriptor <= 24);
}

}  // namespace trismooth

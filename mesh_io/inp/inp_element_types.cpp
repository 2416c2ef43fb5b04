// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_element_types.h"

#include <algorithm>
#include <array>
#include <utility>

#include "trismooth/base/cell_list.h"

namespace trismooth {

namespace {

enum class Shape : std::uint8_t { line, face, solid };

/// Types that begin with `prefix`, then the number of nodes, then letters for variants.
struct Family {
  std::string_view prefix;
  Shape shape;
};

constexpr auto families = std::to_array<Family>({
    {"CPS", Shape::face},    {"CPE", Shape::face},    {"CPEG", Shape::face},   {"CAX", Shape::face},
    {"CGAX", Shape::face},   {"S", Shape::face},      {"DS", Shape::face},     {"STRI", Shape::face},
    {"M3D", Shape::face},    {"DC2D", Shape::face},   {"DCAX", Shape::face},   {"DCC2D", Shape::face},
    {"DCCAX", Shape::face},  {"AC2D", Shape::face},   {"ACAX", Shape::face},   {"SFM3D", Shape::face},
    {"R3D", Shape::face},    {"ACIN3D", Shape::face}, {"EMC2D", Shape::face},  {"WARP2D", Shape::face},
    {"Q2D", Shape::face},    {"QAX", Shape::face},    {"COH2D", Shape::face},  {"COHAX", Shape::face},
    {"GK2D", Shape::face},   {"GKPS", Shape::face},   {"GKPE", Shape::face},   {"GKAX", Shape::face},
    {"T2D", Shape::line},    {"T3D", Shape::line},    {"R2D", Shape::line},    {"RAX", Shape::line},
    {"DC1D", Shape::line},   {"DCC1D", Shape::line},  {"AC1D", Shape::line},   {"ACIN2D", Shape::line},
    {"ACINAX", Shape::line}, {"F2D", Shape::line},    {"FAX", Shape::line},    {"CONN2D", Shape::line},
    {"CONN3D", Shape::line}, {"C3D", Shape::solid},   {"AC3D", Shape::solid},  {"DC3D", Shape::solid},
    {"DCC3D", Shape::solid}, {"SC", Shape::solid},    {"COH3D", Shape::solid}, {"EMC3D", Shape::solid},
    {"EC3D", Shape::solid},  {"CIN3D", Shape::solid}, {"GK3D", Shape::solid},  {"Q3D", Shape::solid},
    {"CSS", Shape::solid},   {"RB2D", Shape::line},   {"RB3D", Shape::line},
});

/// Types whose number is not that of their nodes: beams and pipes of first and second order, and those without one.
/// B33H, which has two nodes, is meshio's name of lines of three: such elements have the nodes that they list.
struct Named {
  std::string_view prefix;
  InpElementType type;
};

constexpr InpElementType two_nodes{cell_type::line, 2};
constexpr InpElementType three_nodes{cell_type::quadratic_edge, 3};
constexpr InpElementType one_node{cell_type::vertex, 1};

constexpr auto named_types = std::to_array<Named>({
    {"B21", two_nodes},       {"B22", three_nodes},    {"B23", two_nodes},
    {"B31", two_nodes},       {"B32", three_nodes},    {"B33H", {}},
    {"B33", two_nodes},       {"PIPE21", two_nodes},   {"PIPE22", three_nodes},
    {"PIPE31", two_nodes},    {"PIPE32", three_nodes}, {"FRAME2D", two_nodes},
    {"FRAME3D", two_nodes},   {"SAX1", two_nodes},     {"SAX2", three_nodes},
    {"DSAX1", two_nodes},     {"DSAX2", three_nodes},  {"MAX1", two_nodes},
    {"MAX2", three_nodes},    {"MGAX1", two_nodes},    {"MGAX2", three_nodes},
    {"SFMAX1", two_nodes},    {"SFMAX2", three_nodes}, {"SFMGAX1", two_nodes},
    {"SFMGAX2", three_nodes}, {"SPRINGA", two_nodes},  {"SPRING2", two_nodes},
    {"SPRING1", one_node},    {"DASHPOTA", two_nodes}, {"DASHPOT2", two_nodes},
    {"DASHPOT1", one_node},   {"GAPUNI", two_nodes},   {"GAPCYL", two_nodes},
    {"GAPSPHER", two_nodes},  {"MASS", one_node},      {"ROTARYI", one_node},
    {"HEATCAP", one_node},    {"PC3D", one_node},      {"PD3D", one_node},
    {"DCOUP2D", one_node},    {"DCOUP3D", one_node},   {"JOINTC", two_nodes},
    {"ITSUNI", two_nodes},    {"ITSCYL", two_nodes},   {"STRI65", {cell_type::quadratic_triangle, 6}},
});

/// Types that are written for cells.
constexpr auto inp_written_types = std::to_array<std::pair<std::uint8_t, std::string_view>>({
    {cell_type::line, "T3D2"},
    {cell_type::quadratic_edge, "T3D3"},
    {cell_type::triangle, "CPS3"},
    {cell_type::quad, "CPS4"},
    {cell_type::quadratic_triangle, "CPS6"},
    {cell_type::quadratic_quad, "CPS8"},
    {cell_type::biquadratic_quad, "M3D9"},
    {cell_type::tetrahedron, "C3D4"},
    {cell_type::pyramid, "C3D5"},
    {cell_type::wedge, "C3D6"},
    {cell_type::hexahedron, "C3D8"},
    {cell_type::quadratic_tetrahedron, "C3D10"},
    {cell_type::quadratic_wedge, "C3D15"},
    {cell_type::quadratic_hexahedron, "C3D20"},
});

std::uint8_t face_of(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return cell_type::triangle;
    case 4:
      return cell_type::quad;
    case 6:
      return cell_type::quadratic_triangle;
    case 8:
      return cell_type::quadratic_quad;
    case 9:
      return cell_type::biquadratic_quad;
    default:
      return 0;
  }
}

std::uint8_t solid_of(std::size_t nodes) {
  switch (nodes) {
    case 4:
      return cell_type::tetrahedron;
    case 5:
      return cell_type::pyramid;
    case 6:
      return cell_type::wedge;
    case 8:
      return cell_type::hexahedron;
    case 10:
      return cell_type::quadratic_tetrahedron;
    case 15:
      return cell_type::quadratic_wedge;
    case 20:
      return cell_type::quadratic_hexahedron;
    default:
      return 0;
  }
}

InpElementType type_of_shape(Shape shape, std::size_t nodes) {
  std::uint8_t cell = 0;
  switch (shape) {
    case Shape::line:
      cell = nodes == 2 ? cell_type::line : nodes == 3 ? cell_type::quadratic_edge : std::uint8_t{0};
      break;
    case Shape::face:
      cell = face_of(nodes);
      break;
    case Shape::solid:
      cell = solid_of(nodes);
      break;
  }
  return cell == 0 ? InpElementType{} : InpElementType{cell, nodes};
}

bool is_digit_of_type(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

InpElementType inp_element_type(std::string_view name) {
  for (const Named& type : named_types) {
    if (name.starts_with(type.prefix)) {
      return type.type;
    }
  }
  // Of families that begin alike one alone has a number behind its prefix.
  for (const Family& family : families) {
    std::string_view rest = name.substr(std::min(family.prefix.size(), name.size()));
    if (!name.starts_with(family.prefix) || rest.empty() || !is_digit_of_type(rest.front())) {
      continue;
    }
    std::size_t nodes = 0;
    for (int digits = 0; digits < 2 && !rest.empty() && is_digit_of_type(rest.front()); ++digits) {
      nodes = 10 * nodes + static_cast<std::size_t>(rest.front() - '0');
      rest.remove_prefix(1);
    }
    if (rest.empty() || !is_digit_of_type(rest.front())) {
      return type_of_shape(family.shape, nodes);
    }
  }
  return {};
}

bool joins_faces(std::string_view name) {
  return name.starts_with("COH") || name.starts_with("GK");
}

std::string_view inp_type_of_cell(std::uint8_t cell) {
  const auto* const found =
      std::ranges::find(inp_written_types, cell, &std::pair<std::uint8_t, std::string_view>::first);
  return found == inp_written_types.end() ? std::string_view() : found->second;
}

}  // namespace trismooth

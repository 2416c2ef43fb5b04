// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/other_cells.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

struct CellName {
  std::uint8_t type;
  std::string_view name;
  std::string_view one;
  std::string_view several;
};

constexpr std::array<CellName, 16> cell_names{{
    {cell_type::vertex, "vertex", "vertex cell", "vertex cells"},
    {cell_type::poly_vertex, "poly_vertex", "poly-vertex", "poly-vertices"},
    {cell_type::line, "line", "line", "lines"},
    {cell_type::poly_line, "poly_line", "poly-line", "poly-lines"},
    {cell_type::triangle, "triangle", "triangle", "triangles"},
    {cell_type::triangle_strip, "triangle_strip", "triangle strip", "triangle strips"},
    {cell_type::polygon, "polygon", "polygon", "polygons"},
    {cell_type::quad, "quad", "quad", "quads"},
    {cell_type::tetrahedron, "tetrahedron", "tetrahedron", "tetrahedra"},
    {cell_type::hexahedron, "hexahedron", "hexahedron", "hexahedra"},
    {cell_type::wedge, "wedge", "wedge", "wedges"},
    {cell_type::pyramid, "pyramid", "pyramid", "pyramids"},
    {cell_type::quadratic_edge, "quadratic_edge", "quadratic edge", "quadratic edges"},
    {cell_type::quadratic_triangle, "quadratic_triangle", "quadratic triangle", "quadratic triangles"},
    {cell_type::quadratic_quad, "quadratic_quad", "quadratic quad", "quadratic quads"},
    {cell_type::biquadratic_quad, "biquadratic_quad", "biquadratic quad", "biquadratic quads"},
}};

const CellName* known_name(std::size_t type) {
  const auto* const known = std::ranges::find(cell_names, type, &CellName::type);
  return known == cell_names.end() ? nullptr : known;
}

std::string describe(std::size_t count, std::size_t type) {
  const CellName* const known = known_name(type);
  return known == nullptr ? std::to_string(count) + " of VTK's cell type " + std::to_string(type)
                          : counted(count, known->one, known->several);
}

}  // namespace

std::array<std::size_t, 256> count_other_cells(const CellList& cells, std::span<const std::uint8_t> kept) {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t type : cells.types) {
    ++counts[type];
  }
  for (const std::uint8_t type : kept) {
    counts[type] = 0;
  }
  return counts;
}

std::string cell_type_name(std::size_t type) {
  const CellName* const known = known_name(type);
  return known == nullptr ? std::to_string(type) + " (by VTK's numbers)" : std::string(known->name);
}

std::string describe_other_cells(const CellList& cells, std::span<const std::uint8_t> kept) {
  const std::array<std::size_t, 256> counts = count_other_cells(cells, kept);
  std::string text;
  for (std::size_t type = 0; type < counts.size(); ++type) {
    if (counts[type] > 0) {
      add_to_list(text, describe(counts[type], type));
    }
  }
  return text;
}

}  // namespace trismooth

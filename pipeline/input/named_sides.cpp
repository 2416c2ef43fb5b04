// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/named_sides.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <map>
#include <utility>

#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/element_cells.h"

namespace trismooth {

namespace {

/// A side, and the array that marks it.
struct Mark {
  std::int32_t low;
  std::int32_t high;
  std::int32_t array;
  auto operator<=>(const Mark&) const = default;
};

/// The bits of a value, one a side; none where it is no number of bits. The first is of the side from the first corner
/// to the second one, the last of that back to the first.
unsigned bits_of(double value, std::size_t sides) {
  const bool has_bits = value > 0 && value < static_cast<double>(1U << sides) && value == static_cast<unsigned>(value);
  return has_bits ? static_cast<unsigned>(value) : 0;
}

void add_marks(const DataArray& array, std::int32_t number, const MeshDocument& document, const ElementCells& mesh,
               std::vector<Mark>& marks) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto cell = static_cast<std::size_t>(mesh.cells[e]);
    if (document.cells.types[cell] == cell_type::triangle_strip) {
      continue;
    }
    const auto corners = mesh.elements[e];
    const unsigned bits = bits_of(array.value(cell), corners.size());
    for (std::size_t side = 0; side < corners.size(); ++side) {
      if ((bits >> side & 1U) != 0) {
        const auto [low, high] = std::minmax({corners[side], next_corner(corners, side)});
        marks.push_back({low, high, number});
      }
    }
  }
}

}  // namespace

NamedSides find_named_sides(const MeshDocument& document, const ElementCells& mesh) {
  NamedSides sides;
  std::vector<Mark> marks;
  std::int32_t number = 0;
  for (const DataArray& array : document.cell_arrays) {
    if (array.components == 1 && is_side_name(array.name)) {
      const std::size_t before = marks.size();
      add_marks(array, number++, document, mesh, marks);
      if (marks.size() > before) {
        sides.names.append(sides.names.empty() ? "'" : ", '").append(array.name).append("'");
      }
    }
  }
  std::ranges::sort(marks);
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
  std::map<std::vector<std::int32_t>, std::int32_t> tags;  // of sides by the arrays that mark them
  for (std::size_t begin = 0, end = 0; begin < marks.size(); begin = end) {
    std::vector<std::int32_t> arrays;
    for (; end < marks.size() && marks[end].low == marks[begin].low && marks[end].high == marks[begin].high; ++end) {
      arrays.push_back(marks[end].array);
    }
    sides.lines.insert(sides.lines.end(), {marks[begin].low, marks[begin].high});
    sides.tags.push_back(tags.try_emplace(std::move(arrays), static_cast<std::int32_t>(tags.size())).first->second);
  }
  return sides;
}

}  // namespace trismooth

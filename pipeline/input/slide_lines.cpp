// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/slide_lines.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

namespace {

bool is_straight_line(std::uint8_t type) {
  return type == cell_type::line || type == cell_type::poly_line;
}

bool names_lines(const DataArray& array) {
  return array.description != nullptr && std::ranges::any_of(array.description->value_names, [](const ValueName& name) {
           return name.dimension == cell_type::dimension(cell_type::line);
         });
}

/// Whether the values of an array tell lines apart: of regions, or of a name under which programs write them, or names
/// of lines. Else whole numbers do, for there are more names than anybody could list, unless they are as many as if
/// they numbered the lines: better a vertex too many stays.
bool tells_lines_apart(const DataArray& array, std::span<const RegionArray> regions,
                       std::span<const std::int32_t> line_cells, const ValueNumbers& numbers) {
  return names_lines(array) || is_region_name(array.name) ||
         std::ranges::any_of(regions, [&](const RegionArray& region) { return region.name == array.name; }) ||
         (2 * std::int64_t{numbers.count()} <= std::ssize(line_cells) && are_whole(array, line_cells, numbers));
}

}  // namespace

SlideLines find_slide_lines(const MeshDocument& document, const ElementCells& mesh,
                            std::span<const RegionArray> regions) {
  SlideLines found;
  const CellList& cells = document.cells;
  found.in_other_cell.assign(mesh.in_other_cell.size(), 0);
  if (mesh.other_cells > 0) {
    // (What the mesh keeps as it is: all cells but its triangles.)
    std::vector<std::int32_t> line_cells;
    std::vector<std::uint8_t> has_triangles(cells.size(), 0);
    for (const std::int32_t cell : mesh.cells) {
      has_triangles[cell] = 1;
    }
    for (const CellCopy& copy : mesh.copies) {
      has_triangles[copy.cell] = 1;
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (has_triangles[c] != 0) {
        continue;
      }
      if (is_straight_line(type_of_fixed_order(cells.types[c], cells[c].size())) && cells[c].size() >= 2) {
        line_cells.push_back(static_cast<std::int32_t>(c));
        continue;
      }
      for (const std::int32_t v : cells[c]) {
        found.in_other_cell[v] = 1;
      }
    }
    if (!line_cells.empty()) {
      found.notes.push_back(
          counted(line_cells.size(), "of these cells is a line, which holds", "of these cells are lines, which hold") +
          " nothing with --slide: their vertices slide where nothing else holds them");
    }
    ValueNumbers tags;
    tags.of_item.assign(line_cells.size(), 0);
    for (const DataArray& array : document.cell_arrays) {
      if (array.components != 1) {
        continue;
      }
      const ValueNumbers numbers = number_values(array, line_cells);
      if (tells_lines_apart(array, regions, line_cells, numbers)) {
        tags = number_pairs(tags, numbers);
      }
    }
    for (std::size_t i = 0; i < line_cells.size(); ++i) {
      const auto vertices = cells[line_cells[i]];
      for (std::size_t j = 0; j + 1 < vertices.size(); ++j) {
        found.lines.insert(found.lines.end(), {vertices[j], vertices[j + 1]});
        found.tags.push_back(tags.of_item[i]);
        found.of_cell.push_back(line_cells[i]);
      }
    }
  }
  const NamedSides& sides = mesh.sides;
  const auto line_tags = found.tags.empty() ? 0 : *std::ranges::max_element(found.tags) + 1;
  found.lines.insert(found.lines.end(), sides.lines.begin(), sides.lines.end());
  for (const std::int32_t tag : sides.tags) {
    found.tags.push_back(line_tags + tag);
    found.of_cell.push_back(-1);
  }
  for (const auto& [first, second] : document.periodic_pairs) {
    found.links.insert(found.links.end(), {first, second});
  }
  return found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/straight_cells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/document/array_rows.h"

namespace trismooth {

namespace {

/// The straight cell of a curved one's corners, which come first.
struct StraightCell {
  std::uint8_t type = 0;
  std::size_t corners = 0;  ///< 0: the cell is none of those that become straight
};

StraightCell straight_cell_of(std::uint8_t type, CurvedCells which) {
  if (which == CurvedCells::eight_node_quads && type != cell_type::quadratic_quad) {
    return {};
  }
  switch (type) {
    case cell_type::quadratic_edge:
      return {cell_type::line, 2};
    case cell_type::quadratic_triangle:
      return {cell_type::triangle, 3};
    case cell_type::quadratic_quad:
    case cell_type::biquadratic_quad:
      return {cell_type::quad, 4};
    default:
      return {};
  }
}

/// The new number of each point, -1 for those that are left out.
std::vector<std::int32_t> renumbered(std::vector<bool> left_out) {
  std::vector<std::int32_t> numbers(left_out.size());
  std::int32_t next = 0;
  for (std::size_t point = 0; point < left_out.size(); ++point) {
    numbers[point] = left_out[point] ? -1 : next++;
  }
  return numbers;
}

void renumber(std::vector<NamedSet>& sets, const std::vector<std::int32_t>& numbers) {
  for (NamedSet& set : sets) {
    for (std::int32_t& member : set.members) {
      member = numbers[static_cast<std::size_t>(member)];
    }
    std::erase(set.members, -1);
  }
}

}  // namespace

bool has_curved_cells(const MeshDocument& document, CurvedCells which) {
  return std::ranges::any_of(document.cells.types,
                             [which](std::uint8_t type) { return straight_cell_of(type, which).corners > 0; });
}

MeshDocument with_straight_cells(const MeshDocument& document, CurvedCells which) {
  MeshDocument straight = document;
  straight.original = nullptr;
  straight.cells = {};
  std::vector<bool> left_out(document.point_count());
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const auto vertices = document.cells[cell];
    const StraightCell corners = straight_cell_of(document.cells.types[cell], which);
    straight.cells.append(corners.corners > 0 ? corners.type : document.cells.types[cell],
                          corners.corners > 0 ? vertices.first(corners.corners) : vertices);
    for (const std::int32_t middle : vertices.subspan(corners.corners > 0 ? corners.corners : vertices.size())) {
      left_out[static_cast<std::size_t>(middle)] = true;
    }
  }
  for (const std::int32_t vertex : straight.cells.connectivity) {
    left_out[static_cast<std::size_t>(vertex)] = false;
  }
  const std::vector<std::int32_t> numbers = renumbered(std::move(left_out));
  std::vector<std::size_t> rows;
  straight.points.clear();
  for (std::size_t point = 0; point < numbers.size(); ++point) {
    if (numbers[point] >= 0) {
      rows.push_back(point);
      const auto first = document.points.begin() + static_cast<std::ptrdiff_t>(3 * point);
      straight.points.insert(straight.points.end(), first, first + 3);
    }
  }
  for (std::int32_t& vertex : straight.cells.connectivity) {
    vertex = numbers[static_cast<std::size_t>(vertex)];
  }
  for (DataArray& array : straight.point_arrays) {
    array = with_rows(array, rows);
  }
  renumber(straight.point_sets, numbers);
  renumber(straight.implied_sets, numbers);
  return straight;
}

}  // namespace trismooth

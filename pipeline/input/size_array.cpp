// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/size_array.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

namespace {

/// The value of a one-component array at a row, which must be a positive number.
double size_at(const DataArray& array, std::size_t row, const char* what, const char* place) {
  const double value = array.value(row);
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("the {} array '{}' is {} at {} {}; sizes must be positive numbers", what,
                                            array.name, value_text(array, row), place, row));
  }
  return value;
}

void require_one_component(const DataArray& array, const char* what) {
  if (array.components != 1) {
    throw std::invalid_argument(
        fmt::format("the {} array '{}' has {} components; sizes need one", what, array.name, array.components));
  }
}

SizeArray lengths_at_points(const DataArray& array, const PlanarMesh& mesh) {
  require_one_component(array, "point");
  SizeArray sizes{array.name, false, std::vector<double>(mesh.points.size(), 0)};
  std::vector<std::uint8_t> in_element(mesh.points.size(), 0);
  for (const auto corners : mesh.elements) {
    for (const std::int32_t v : corners) {
      in_element[v] = 1;
    }
  }
  for (std::size_t v = 0; v < sizes.lengths.size(); ++v) {
    if (in_element[v] != 0) {
      sizes.lengths[v] = size_at(array, v, "point", "point");
    }
  }
  return sizes;
}

SizeArray areas_of_cells(const DataArray& array, const PlanarMesh& mesh) {
  require_one_component(array, "cell");
  std::vector<double> areas(mesh.elements.size());
  double largest = 0;
  for (std::size_t begin = 0, end = 0; begin < areas.size(); begin = end) {
    // A strip has several triangles, one after the other, and its area is that of all of them, also of copies.
    while (end < areas.size() && mesh.cells[end] == mesh.cells[begin]) {
      ++end;
    }
    const double area = size_at(array, static_cast<std::size_t>(mesh.cells[begin]), "cell", "cell");
    std::fill(areas.begin() + static_cast<std::ptrdiff_t>(begin), areas.begin() + static_cast<std::ptrdiff_t>(end),
              area / static_cast<double>(end - begin + copies_in_cell(mesh.copies, mesh.cells[begin]).size()));
    largest = std::max(largest, areas[begin]);
  }
  // By the largest, sums are within the range of double.
  const int exponent = std::ilogb(largest);
  std::vector<double> sums(mesh.points.size(), 0);
  std::vector<std::int32_t> counts(mesh.points.size(), 0);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto corners = mesh.elements[t];
    // (Of a quadrilateral half, which is what the method compares with triangles.)
    const double area = std::ldexp(areas[t], corners.size() == 4 ? -exponent - 1 : -exponent);
    for (const std::int32_t v : corners) {
      sums[v] += area;
      ++counts[v];
    }
  }
  SizeArray sizes{array.name, true, std::move(sums)};
  for (std::size_t v = 0; v < sizes.lengths.size(); ++v) {
    if (counts[v] > 0) {
      // sqrt(3) / 4 h^2 = area; all by the same factor, which sizes do not need
      // An area so much smaller than the largest that it is lost beside it is the smallest number.
      sizes.lengths[v] = std::sqrt(4 / std::numbers::sqrt3 *
                                   std::max(sizes.lengths[v] / counts[v], std::numeric_limits<double>::min()));
    }
  }
  return sizes;
}

}  // namespace

SizeArray find_size_array(const MeshDocument& document, const PlanarMesh& mesh, const std::string& name) {
  const auto by = [&](const auto& find) {
    const DataArray* const at_points = find(document.point_arrays, name);
    const DataArray* const of_cells = at_points == nullptr ? find(document.cell_arrays, name) : nullptr;
    return at_points != nullptr  ? std::optional(lengths_at_points(*at_points, mesh))
           : of_cells != nullptr ? std::optional(areas_of_cells(*of_cells, mesh))
                                 : std::nullopt;
  };
  // A cell array of the very name goes before a point array whose name only resembles it.
  if (std::optional<SizeArray> exact = by(find_array)) {
    return *std::move(exact);
  }
  if (std::ranges::find(document.cell_labels, name, &LabelArray::name) != document.cell_labels.end()) {
    throw std::invalid_argument("the cell array '" + name + "' holds texts; sizes must be positive numbers");
  }
  if (std::optional<SizeArray> similar = by(find_array_loosely)) {
    return *std::move(similar);
  }
  throw std::invalid_argument("the file has no point or cell array '" + name +
                              "' to take sizes from; it has: " + array_names(document.point_arrays) + " at points, " +
                              array_names(document.cell_arrays) + " at cells");
}

}  // namespace trismooth

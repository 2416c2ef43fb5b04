#include "trismooth/mesh_io/document/strip_triangles.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace trismooth {

namespace {

/// The array with a row for each of `rows`, which number rows of `array`.
DataArray with_rows(const DataArray& array, std::span<const std::size_t> rows) {
  const std::size_t row_bytes = array.components * size_of(array.type);
  std::vector<std::byte> bytes;
  bytes.reserve(rows.size() * row_bytes);
  for (const std::size_t row : rows) {
    const auto from = array.bytes.subspan(row * row_bytes, row_bytes);
    bytes.insert(bytes.end(), from.begin(), from.end());
  }
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {array.name, array.type, array.components, *owner, owner};
}

}  // namespace

bool has_strips(const MeshDocument& document) {
  return std::ranges::find(document.cells.types, cell_type::triangle_strip) != document.cells.types.end();
}

MeshDocument with_strips_as_triangles(const MeshDocument& document) {
  MeshDocument expanded = document;
  expanded.original = nullptr;
  expanded.cells = {};
  std::vector<std::size_t> cell_of;  // of each new cell
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (document.cells.types[cell] == cell_type::triangle_strip) {
      for_each_strip_triangle(document.cells[cell],
                              [&](const Triangle& triangle) { expanded.cells.append(cell_type::triangle, triangle); });
    } else {
      expanded.cells.append(document.cells.types[cell], document.cells[cell]);
    }
    cell_of.resize(expanded.cells.size(), cell);
  }
  for (DataArray& array : expanded.cell_arrays) {
    array = with_rows(array, cell_of);
  }
  return expanded;
}

}  // namespace trismooth

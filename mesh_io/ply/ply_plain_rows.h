#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/ply/ply_header.h"
#include "trismooth/mesh_io/ply/scalar_column.h"

namespace trismooth {

// Rows of a PLY file that are all alike, read in parts, by all workers. Where anything in them is unusual or wrong the
// answer is false, the source stands where it stood, and somebody else has to read them, and to say what is wrong.
// Source is PlyTextSource or PlyBinarySource.

/// Reads the next number, of the column's type, into a row of it.
template <class Numbers>
bool read_plain_number(Numbers& numbers, ScalarColumn& column, std::size_t row) {
  return visit_scalar_type(column.type(), [&](auto value) {
    const bool plain = numbers.next(value);
    column.put(row, value);
    return plain;
  });
}

/// Reads the next number as a coordinate of type T, and where it stands.
template <class T, class Numbers>
bool read_plain_coordinate(Numbers& numbers, double& coordinate, std::uint64_t& site) {
  T value{};
  const bool plain = numbers.next(value) && std::isfinite(value);
  coordinate = static_cast<double>(value);
  site = numbers.token_offset();
  return plain;
}

/// The next number, of an integer type; -1 where it is of another type, negative or beyond int64.
template <class Numbers>
std::int64_t plain_count(Numbers& numbers, ScalarType type) {
  return visit_scalar_type(type, [&](auto value) -> std::int64_t {
    if constexpr (std::is_integral_v<decltype(value)>) {
      return numbers.next(value) ? static_cast<std::int64_t>(value) : -1;
    }
    return -1;
  });
}

/// Reads the next `indices.size()` numbers, which are of an integer type and below `vertices`.
template <class Numbers>
bool read_plain_indices(Numbers& numbers, ScalarType type, std::uint64_t vertices, std::span<std::int32_t> indices) {
  return visit_scalar_type(type, [&](auto value) {
    for (std::int32_t& index : indices) {
      if (!numbers.next(value) || value < 0 || static_cast<std::uint64_t>(value) >= vertices) {
        return false;
      }
      index = static_cast<std::int32_t>(value);
    }
    return true;
  });
}

/// Whether the source has room for the rows of the element, if each has numbers of these types: of text, for the
/// shortest ones.
template <class Source>
bool has_room(const Source& source, std::uint64_t rows, std::span<const ScalarType> types) {
  std::uint64_t bytes = 0;
  for (const ScalarType type : types) {
    bytes += Source::least_bytes(type);
  }
  return bytes > 0 && rows <= source.room() / bytes;
}

/// Reads the element "vertex": the properties for which axis_of_property is 0, 1 or 2 to `points` and their sites, all
/// others to their columns; all have their size. Lists are not plain.
template <class Source>
bool read_plain_vertices(Source& source, const PlyElement& element, std::span<const int> axis_of_property,
                         std::span<double> points, std::span<std::uint64_t> sites, ScalarColumns& columns) {
  std::vector<ScalarType> types;
  for (const PlyProperty& property : element.properties) {
    if (property.is_list()) {
      return false;
    }
    types.push_back(property.type);
  }
  if (element.count == 0 || !has_room(source, element.count, types)) {
    return false;
  }
  return source.read_plain_rows(element.count, types, [&](auto& numbers, std::size_t first, std::size_t last) {
    bool plain = true;
    for (std::size_t row = first; row < last && plain; ++row) {
      for (std::size_t p = 0; p < types.size() && plain; ++p) {
        if (axis_of_property[p] < 0) {
          plain = read_plain_number(numbers, *columns[p], row);
          continue;
        }
        const std::size_t i = 3 * row + static_cast<std::size_t>(axis_of_property[p]);
        plain = types[p] == ScalarType::float32 ? read_plain_coordinate<float>(numbers, points[i], sites[i])
                                                : read_plain_coordinate<double>(numbers, points[i], sites[i]);
      }
      plain = plain && numbers.at_end_of_line();
    }
    return plain;
  });
}

/// Reads faces that all have as many vertices as the first one, in the list at position `list`, and appends them;
/// scalar properties go to their columns. Other lists are not plain.
template <class Source>
bool read_plain_faces(Source& source, const PlyElement& element, std::size_t list, std::uint64_t vertices,
                      CellList& cells, ScalarColumns& columns, Workers& workers) {
  const PlyProperty& property = element.properties[list];
  auto first_row = source.plain_numbers();
  std::int64_t declared = -1;
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    if (p == list) {
      declared = plain_count(first_row, *property.count_type);
    } else if (element.properties[p].is_list()) {
      return false;
    } else if (p < list && !read_plain_number(first_row, *columns[p], 0)) {
      return false;
    }
  }
  if (declared < 3 || static_cast<std::uint64_t>(declared) > source.room()) {
    return false;
  }
  const auto degree = static_cast<std::size_t>(declared);
  std::vector<ScalarType> types(degree, property.type);
  types.push_back(*property.count_type);
  for (const auto& column : columns) {
    if (column) {
      types.push_back(column->type());
    }
  }
  if (!has_room(source, element.count, types)) {
    return false;
  }
  const std::size_t cells_before = cells.size();
  const std::size_t corners_before = cells.connectivity.size();
  shared_resize(cells.connectivity, corners_before + degree * element.count, cells.offsets,
                cells_before + element.count + 1, workers);
  shared_resize(cells.types, cells_before + element.count, workers);
  const bool plain =
      source.read_plain_rows(element.count, types, [&](auto& numbers, std::size_t first, std::size_t last) {
        bool all = true;
        for (std::size_t row = first; row < last && all; ++row) {
          const std::size_t corner = corners_before + degree * row;
          for (std::size_t p = 0; p < columns.size() && all; ++p) {
            all = p != list ? read_plain_number(numbers, *columns[p], row)
                            : plain_count(numbers, *property.count_type) == declared &&
                                  read_plain_indices(numbers, property.type, vertices,
                                                     std::span(cells.connectivity).subspan(corner, degree));
          }
          all = all && numbers.at_end_of_line();
          cells.offsets[cells_before + row + 1] = static_cast<std::int64_t>(corner + degree);
          cells.types[cells_before + row] = cell_type::of_face(degree);
        }
        return all;
      });
  if (!plain) {
    cells.connectivity.resize(corners_before);
    cells.offsets.resize(cells_before + 1);
    cells.types.resize(cells_before);
  }
  return plain;
}

}  // namespace trismooth

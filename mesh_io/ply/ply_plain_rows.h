// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/ply/ply_header.h"
#include "trismooth/mesh_io/ply/scalar_column.h"
#include "trismooth/mesh_io/text/plain_count.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"

namespace trismooth {

// Rows of a PLY file, read in parts, by all workers. Where anything in them is unusual or wrong the
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

/// Reads the next `indices.size()` numbers, which are of an integer type and below `vertices`.
template <class Numbers>
bool read_plain_indices(Numbers& numbers, ScalarType type, std::uint64_t vertices, std::span<std::int32_t> indices) {
  return visit_scalar_type(type, [&](auto value) {
    if constexpr (std::is_integral_v<decltype(value)>) {
      for (std::int32_t& index : indices) {
        const bool plain = numbers.next(value) && value >= 0;
        const auto vertex = static_cast<std::make_unsigned_t<decltype(value)>>(value);
        if (!plain || vertex >= vertices) {
          return false;
        }
        index = static_cast<std::int32_t>(vertex);
      }
      return true;
    }
    return false;
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

/// Reads the element "vertex": the properties whose site is 0, 1 or 2 to `points`, all others to their columns, and
/// where those stand that have a site (0 or more) to `sites`, of which a row has `site_count`; all have their size.
/// Lists are not plain.
template <class Source>
bool read_plain_vertices(Source& source, const PlyElement& element, std::span<const int> site_of_property,
                         std::size_t site_count, std::span<double> points, std::span<std::uint64_t> sites,
                         ScalarColumns& columns) {
  std::vector<ScalarType> types;
  for (const PlyProperty& property : element.properties) {
    if (property.is_list()) {
      return false;
    }
    types.push_back(property.type);
  }
  if (element.count == 0 || !source.reads_parts() || !has_room(source, element.count, types)) {
    return false;
  }
  return source.read_plain_rows(element.count, types, [&](auto& numbers, std::size_t first, std::size_t last) {
    bool plain = true;
    for (std::size_t row = first; row < last && plain; ++row) {
      for (std::size_t p = 0; p < types.size() && plain; ++p) {
        if (site_of_property[p] < 0) {
          plain = read_plain_number(numbers, *columns[p], row);
          continue;
        }
        const auto column = static_cast<std::size_t>(site_of_property[p]);
        std::uint64_t& site = sites[site_count * row + column];
        if (column >= 3) {
          plain = read_plain_number(numbers, *columns[p], row);
          site = numbers.token_offset();
          continue;
        }
        double& coordinate = points[3 * row + column];
        plain = types[p] == ScalarType::float32 ? read_plain_coordinate<float>(numbers, coordinate, site)
                                                : read_plain_coordinate<double>(numbers, coordinate, site);
      }
      plain = plain && numbers.at_end_of_line();
    }
    return plain;
  });
}

/// Reads the element "face": appends its rows to the cells.
template <class Source>
class PlainFaceReader {
 public:
  /// `list` is the position of the list of vertices, of which the file has `vertices`. Scalar properties go to their
  /// columns, which have their size. Other lists are not plain.
  PlainFaceReader(Source& source, const PlyElement& element, std::size_t list, std::uint64_t vertices, CellList& cells,
                  ScalarColumns& columns, Workers& workers)
      : source_(source),
        element_(element),
        list_(list),
        vertices_(vertices),
        cells_(cells),
        columns_(columns),
        workers_(workers),
        cells_before_(cells.size()),
        corners_before_(cells.connectivity.size()) {}

  bool read() {
    const auto lists = std::ranges::count_if(element_.properties, &PlyProperty::is_list);
    if (element_.count == 0 || lists != 1 || !source_.reads_parts()) {
      return false;
    }
    if (read_equal() || read_mixed()) {
      return true;
    }
    make_room(0, 0);
    return false;
  }

 private:
  struct Degrees {
    std::int64_t least;
    std::int64_t most;
  };

  /// Faces with as many vertices as the first one.
  bool read_equal() {
    auto first_row = source_.plain_numbers();
    for (std::size_t p = 0; p < list_; ++p) {
      if (!read_plain_number(first_row, *columns_[p], 0)) {
        return false;
      }
    }
    const PlyProperty& property = element_.properties[list_];
    const std::int64_t declared = next_plain_count(first_row, *property.count_type);
    if (declared < 3 || static_cast<std::uint64_t>(declared) > source_.room()) {
      return false;
    }
    const auto degree = static_cast<std::size_t>(declared);
    std::vector<ScalarType> types(degree, property.type);
    types.push_back(*property.count_type);
    for (const auto& column : columns_) {
      if (column) {
        types.push_back(column->type());
      }
    }
    if (!has_room(source_, element_.count, types)) {
      return false;
    }
    make_room(element_.count, degree * element_.count);
    return source_.read_plain_rows(element_.count, types, [&](auto& numbers, std::size_t first, std::size_t last) {
      return read_part(numbers, {first, last, degree * first, degree * last}, {declared, declared});
    });
  }

  bool read_mixed() {
    const auto rows = source_.find_plain_lists(element_, list_);
    if (!rows.items()) {
      return false;
    }
    make_room(element_.count, *rows.items());
    const auto end = rows.read([&](auto& numbers, const PlainListRows::Part& part) {
      return read_part(numbers, part, {3, std::numeric_limits<std::int32_t>::max()});
    });
    if (end) {
      source_.resume(*end);
    }
    return end.has_value();
  }

  void make_room(std::size_t faces, std::size_t corners) {
    shared_resize(cells_.connectivity, corners_before_ + corners, cells_.offsets, cells_before_ + faces + 1, workers_);
    shared_resize(cells_.types, cells_before_ + faces, workers_);
  }

  template <class Numbers>
  bool read_part(Numbers& numbers, const PlainListRows::Part& part, Degrees degrees) {
    const PlyProperty& property = element_.properties[list_];
    std::size_t item = part.first_item;
    for (std::size_t row = part.first; row < part.last; ++row) {
      std::size_t degree = 0;
      for (std::size_t p = 0; p < columns_.size(); ++p) {
        if (p != list_) {
          if (!read_plain_number(numbers, *columns_[p], row)) {
            return false;
          }
          continue;
        }
        const std::int64_t declared = next_plain_count(numbers, *property.count_type);
        if (declared < degrees.least || declared > degrees.most ||
            static_cast<std::uint64_t>(declared) > part.last_item - item) {
          return false;
        }
        degree = static_cast<std::size_t>(declared);
        if (!read_plain_indices(numbers, property.type, vertices_,
                                std::span(cells_.connectivity).subspan(corners_before_ + item, degree))) {
          return false;
        }
        item += degree;
      }
      if (!numbers.at_end_of_line()) {
        return false;
      }
      cells_.offsets[cells_before_ + row + 1] = static_cast<std::int64_t>(corners_before_ + item);
      cells_.types[cells_before_ + row] = cell_type::of_face(degree);
    }
    return true;
  }

  Source& source_;
  const PlyElement& element_;
  std::size_t list_;
  std::uint64_t vertices_;
  CellList& cells_;
  ScalarColumns& columns_;
  Workers& workers_;
  std::size_t cells_before_;
  std::size_t corners_before_;
};

}  // namespace trismooth

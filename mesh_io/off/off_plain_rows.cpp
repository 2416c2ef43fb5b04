// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_plain_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/text/plain_line.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"

namespace trismooth {

namespace {

/// The numbers behind the coordinates of a vertex, or the vertices of a face: as many as a line has at most.
using Fields = std::array<double, 9>;

bool read_indices(PlainNumbers& numbers, std::int32_t vertices, std::span<std::int32_t> indices) {
  return std::ranges::all_of(indices, [&numbers, vertices](std::int32_t& index) {
    return numbers.next(index) && index >= 0 && index < vertices;
  });
}

/// Reads as many numbers as there are values, which end the line.
bool read_fields(PlainNumbers& numbers, std::span<double> values) {
  return std::ranges::all_of(values,
                             [&numbers](double& value) {
                               return !numbers.at_end_of_line() && numbers.next(value) && std::isfinite(value);
                             }) &&
         numbers.at_end_of_line();
}

void copy_row(std::span<const double> values, std::vector<double>& rows, std::size_t row) {
  std::ranges::copy(values, rows.begin() + static_cast<std::ptrdiff_t>(row * values.size()));
}

}  // namespace

std::optional<PlainRows::End> OffPlainRows::read_vertices(std::size_t offset, std::size_t count,
                                                          const OffKeyword& keyword, MeshDocument& document,
                                                          NumberSites& sites) {
  Fields fields{};
  PlainNumbers first_row(rows_.text(), offset);
  std::array<double, 3> point{};
  const bool has_point = std::ranges::all_of(point, [&first_row](double& x) { return first_row.next(x); });
  const std::optional<std::size_t> found = has_point ? count_rest_of_line(first_row, fields.size()) : std::nullopt;
  if (!found || !keyword.allows_extras(*found) || !rows_.has_room(offset, count, 3 + *found)) {
    return std::nullopt;
  }
  const std::size_t field_count = *found;
  const OffExtras sizes = keyword.split(std::span(fields).first(field_count));
  std::vector<double> normals;
  std::vector<double> colours;
  std::vector<double> texture_coordinates;
  shared_resize(normals, sizes.normal.size() * count, colours, sizes.colour.size() * count, rows_.workers().workers);
  shared_resize(texture_coordinates, sizes.texture.size() * count, rows_.workers().workers);
  const auto end =
      rows_.read(offset, count, 3 + field_count, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
        bool plain = true;
        for (std::size_t vertex = first; vertex < last && plain; ++vertex) {
          for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
            plain = plain && numbers.next(document.points[i]) && std::isfinite(document.points[i]);
            sites.offsets[i] = numbers.token_offset();
          }
          if (field_count == 0) {
            plain = plain && numbers.at_end_of_line();
            continue;
          }
          Fields values;
          plain = plain && read_fields(numbers, std::span(values).first(field_count));
          const OffExtras parts = keyword.split(std::span(values).first(field_count));
          copy_row(parts.normal, normals, vertex);
          copy_row(parts.colour, colours, vertex);
          copy_row(parts.texture, texture_coordinates, vertex);
        }
        return plain;
      });
  if (!end) {
    return std::nullopt;
  }
  const auto add = [&document](const char* name, std::size_t components, std::vector<double>& values) {
    if (components > 0) {
      document.point_arrays.push_back(make_data_array(name, components, std::move(values)));
    }
  };
  add("normals", sizes.normal.size(), normals);
  add("colours", sizes.colour.size(), colours);
  add("texture_coordinates", sizes.texture.size(), texture_coordinates);
  return end;
}

std::optional<PlainRows::End> OffPlainRows::read_faces(std::size_t offset, std::size_t count, std::size_t vertices,
                                                       MeshDocument& document) {
  PlainNumbers first_face(rows_.text(), offset);
  std::size_t degree = 0;
  if (!first_face.next(degree) || degree < 3 || degree > rows_.text().size() - offset || !first_face.skip(degree)) {
    return std::nullopt;
  }
  const std::optional<std::size_t> found = count_rest_of_line(first_face, 4);
  if (!found || *found == 2) {
    return std::nullopt;
  }
  const std::size_t components = *found;
  CellList& cells = document.cells;
  std::vector<double> colours;
  const auto make_room = [&](std::size_t corners) {
    shared_resize(cells.connectivity, corners, cells.offsets, count + 1, rows_.workers().workers);
    shared_resize(cells.types, count, colours, components * count, rows_.workers().workers);
  };
  const auto index_end = static_cast<std::int32_t>(vertices);
  const auto read_part = [&](PlainNumbers& numbers, const PlainListRows::Part& part) {
    std::size_t item = part.first_item;
    for (std::size_t face = part.first; face < part.last; ++face) {
      std::size_t corners = 0;
      if (!numbers.next(corners) || corners < 3 || corners > part.last_item - item ||
          !read_indices(numbers, index_end, std::span(cells.connectivity).subspan(item, corners)) ||
          !read_fields(numbers, std::span(colours).subspan(components * face, components))) {
        return false;
      }
      item += corners;
      cells.offsets[face + 1] = static_cast<std::int64_t>(item);
      cells.types[face] = cell_type::of_face(corners);
    }
    return item == part.last_item;
  };
  const auto end = read_plain_lists(rows_, offset, count, {degree, components}, true, make_room, read_part);
  if (!end) {
    cells = {};
  } else if (components > 0) {
    document.cell_arrays.push_back(make_data_array("colours", components, std::move(colours)));
  }
  return end;
}

}  // namespace trismooth

#include "trismooth/mesh_io/su2/su2_plain_rows.h"

#include <algorithm>
#include <cmath>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/text/plain_line.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"

namespace trismooth {

namespace {

/// Numbers behind the first one of a row.
constexpr std::size_t most_su2_rest = 16;

}  // namespace

std::optional<PlainRows::End> Su2PlainRows::read_points(std::size_t offset, std::size_t first, MeshDocument& document,
                                                        NumberSites& sites) {
  const std::size_t count = document.point_count() - first;
  const std::size_t dimension = sites.columns.size();
  PlainNumbers first_row(rows_.text(), offset);
  double first_number = 0;
  if (!first_row.next(first_number)) {
    return std::nullopt;
  }
  const std::optional<std::size_t> rest = count_rest_of_line(first_row, most_su2_rest);
  if (!rest || *rest + 1 < dimension || !rows_.has_room(offset, count, *rest + 1)) {
    return std::nullopt;
  }
  const std::size_t others = *rest + 1 - dimension;
  const auto read_point = [&](PlainNumbers& numbers, std::size_t point) {
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      double& x = document.points[3 * point + axis];
      if ((axis > 0 && numbers.at_end_of_line()) || !numbers.next(x) || !std::isfinite(x)) {
        return false;
      }
      sites.offsets[dimension * point + axis] = numbers.token_offset();
    }
    return skip_rest_of_line<double>(numbers, others);
  };
  return rows_.read(offset, count, dimension + others, [&](PlainNumbers& numbers, std::size_t from, std::size_t to) {
    bool plain = true;
    for (std::size_t row = from; row < to && plain; ++row) {
      plain = read_point(numbers, first + row);
    }
    return plain;
  });
}

std::optional<PlainRows::End> Su2PlainRows::read_elements(std::size_t offset, std::size_t count, int dimension,
                                                          Indices indices, CellList& cells) {
  PlainNumbers first_row(rows_.text(), offset);
  std::int64_t first_type = 0;
  if (!first_row.next(first_type)) {
    return std::nullopt;
  }
  const std::size_t points = su2_points_of(Su2Section::elements, dimension, first_type);
  const std::optional<std::size_t> rest = count_rest_of_line(first_row, most_su2_rest);
  if (points == 0 || !rest || *rest < points || *rest > points + 1) {
    return std::nullopt;
  }
  const std::size_t others = *rest - points;
  const std::size_t cells_before = cells.size();
  const std::size_t items_before = cells.connectivity.size();
  const auto make_room = [&](std::size_t items) {
    shared_resize(cells.connectivity, items_before + items, cells.offsets, cells_before + count + 1,
                  rows_.workers().workers);
    shared_resize(cells.types, cells_before + count, rows_.workers().workers);
  };
  const auto read_row = [&](PlainNumbers& numbers, std::size_t row, std::size_t& item, std::size_t last_item) {
    std::int64_t type = 0;
    if (!numbers.next(type)) {
      return false;
    }
    const std::size_t size = su2_points_of(Su2Section::elements, dimension, type);
    if (size == 0 || size > last_item - item) {
      return false;
    }
    for (const std::size_t end = item + size; item < end; ++item) {
      std::int32_t index = 0;
      if (!next_on_line(numbers, index) || index < 0 || index >= indices.count) {
        return false;
      }
      cells.connectivity[items_before + item] = indices.first + index;
    }
    cells.offsets[cells_before + row + 1] = static_cast<std::int64_t>(items_before + item);
    cells.types[cells_before + row] = static_cast<std::uint8_t>(type);
    return skip_rest_of_line<std::int64_t>(numbers, others);
  };
  const auto read_part = [&](PlainNumbers& numbers, const PlainListRows::Part& part) {
    std::size_t item = part.first_item;
    for (std::size_t row = part.first; row < part.last; ++row) {
      if (!read_row(numbers, row, item, part.last_item)) {
        return false;
      }
    }
    return item == part.last_item;
  };
  // Where types differ: this looks at all of the rest of the file, which pays for large sections only, and may not be
  // done for each of many small ones.
  constexpr std::size_t least_row = 8;
  const bool is_large = count >= (rows_.text().size() - offset) / 16 / least_row;
  const auto end = read_plain_lists(rows_, offset, count, {points, others}, is_large, make_room, read_part);
  if (!end) {
    cells.connectivity.resize(items_before);
    cells.offsets.resize(cells_before + 1);
    cells.types.resize(cells_before);
  }
  return end;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/su2/su2_rows.h"

#include <limits>
#include <optional>
#include <span>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_line.h"

namespace trismooth {

namespace {

/// Numbers behind the first one of a row.
constexpr std::size_t most_su2_rest = 16;

std::string_view expected_types(const Su2Cells& of) {
  if (of.section == Su2Section::marker && of.dimension == 2) {
    return "3 (a line) or 1 (a point)";
  }
  return of.section == Su2Section::marker ? "5 (a triangle), 9 (a quadrilateral), 3 (a line) or 1 (a point)"
                                          : "5 (a triangle), 9 (a quadrilateral) or 3 (a line)";
}

/// "point 3 of 5: ".
template <class Row>
std::string in_row(const Row& row) {
  return std::string(row.kind) + " " + std::to_string(row.number + 1) + " of " + std::to_string(row.count) + ": ";
}

}  // namespace

void Su2Rows::read_points(std::size_t first, MeshDocument& document, NumberSites& sites) {
  const std::size_t count = document.point_count() - first;
  const std::size_t dimension = sites.columns.size();
  PlainNumbers first_row(scanner_.text(), scanner_.offset());
  double first_number = 0;
  const std::optional<std::size_t> rest =
      first_row.next(first_number) ? count_rest_of_line(first_row, most_su2_rest) : std::nullopt;
  const bool may_be_plain = rest && *rest + 1 >= dimension && plain_.has_room(scanner_.offset(), count, *rest + 1);
  others_ = may_be_plain ? *rest + 1 - dimension : 0;
  read_rows(plain_, scanner_, count, dimension + others_, "points", [&](auto& numbers, std::size_t i) {
    const Row row{"point", i, count};
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      if (axis > 0 && numbers.at_end_of_line()) {
        return numbers.fail([&](std::string_view /*token*/) {
          return in_row(row) + "expected " + std::to_string(dimension) + " coordinates, got " + std::to_string(axis);
        });
      }
      if (!numbers.next_real(document.points[3 * (first + i) + axis], "a coordinate")) {
        return false;
      }
      sites.offsets[dimension * (first + i) + axis] = numbers.token_offset();
    }
    return end_point(numbers, row);
  });
}

bool Su2Rows::end_point(PlainNumbers& numbers, const Row& /*row*/) const {
  return skip_rest_of_line<double>(numbers, others_);
}

bool Su2Rows::end_point(CarefulNumbers& numbers, const Row& row) const {
  while (!numbers.at_end_of_line()) {
    const std::string_view token = scanner_.next_token("the end of the line");
    if (!parse_number<double>(token)) {
      scanner_.fail(in_row(row) + "expected a number or the end of the line behind the coordinates, got " +
                    quoted(token));
    }
  }
  return true;
}

void Su2Rows::read_cells(const Su2Cells& of, std::size_t count, CellList& cells) {
  if (of.section == Su2Section::elements && count > 0 && read_plain_cells(of, count, cells)) {
    return;
  }
  CarefulNumbers numbers(scanner_);
  for (std::size_t i = 0; i < count; ++i) {
    if (scanner_.at_end()) {
      scanner_.fail("expected " + std::to_string(count) + " elements, got " + std::to_string(i));
    }
    Cell cell;
    read_cell(numbers, of, {"element", i, count}, cell);
    cells.append(static_cast<std::uint8_t>(cell.type), std::span(cell.vertices).first(cell.points));
  }
}

template <class Numbers>
bool Su2Rows::read_cell(Numbers& numbers, const Su2Cells& of, const Row& row, Cell& cell) const {
  const auto wrong_type = [&](std::string_view token) {
    return in_row(row) + "expected its type, " + std::string(expected_types(of)) + ", got " + quoted(token);
  };
  if (!numbers.next_index(cell.type, "the type of an element", std::numeric_limits<std::int64_t>::min(),
                          std::numeric_limits<std::int64_t>::max(), wrong_type)) {
    return false;
  }
  cell.points = su2_points_of(of.section, of.dimension, cell.type);
  if (cell.points == 0) {
    return numbers.fail([&](std::string_view token) {
      const std::string_view solid = su2_solid_name(cell.type);
      return solid.empty() ? wrong_type(token)
                           : in_row(row) + "a " + std::string(solid) +
                                 "; meshes of solids are not read, only those of triangles and quadrilaterals";
    });
  }
  for (std::size_t corner = 0; corner < cell.points; ++corner) {
    if (numbers.at_end_of_line()) {
      return numbers.fail([&](std::string_view /*token*/) {
        return in_row(row) + "expected " + std::to_string(cell.points) + " points behind its type, got " +
               std::to_string(corner);
      });
    }
    std::int32_t& vertex = cell.vertices[corner];  // NOLINT(cppcoreguidelines-pro-bounds-constant-array-index)
    if (!numbers.next_index(vertex, "a point", 0, of.point_count - 1, [&](std::string_view token) {
          return in_row(row) + "expected a point, got " + quoted(token) + "; " + of.zone + " has " +
                 std::to_string(of.point_count) + " points, counted from 0";
        })) {
      return false;
    }
    vertex += of.first_point;
  }
  return end_cell(numbers, row, cell.points);
}

bool Su2Rows::end_cell(PlainNumbers& numbers, const Row& /*row*/, std::size_t /*points*/) const {
  return skip_rest_of_line<std::int64_t>(numbers, others_);
}

bool Su2Rows::end_cell(CarefulNumbers& numbers, const Row& row, std::size_t points) const {
  if (!numbers.at_end_of_line()) {
    const std::string_view word = scanner_.next_token("the end of the line");
    if (!parse_integer(word) || !numbers.at_end_of_line()) {
      scanner_.fail(in_row(row) + "expected the end of the line behind " + std::to_string(points) +
                    " points and a number of the element, got " + quoted(word));
    }
  }
  return true;
}

/// False where the text has anything unusual in it, or is broken: nothing has changed then.
bool Su2Rows::read_plain_cells(const Su2Cells& of, std::size_t count, CellList& cells) {
  const std::size_t offset = scanner_.offset();
  PlainNumbers first_row(scanner_.text(), offset);
  std::int64_t first_type = 0;
  if (!first_row.next(first_type)) {
    return false;
  }
  const std::size_t points = su2_points_of(of.section, of.dimension, first_type);
  const std::optional<std::size_t> rest = count_rest_of_line(first_row, most_su2_rest);
  if (points == 0 || !rest || *rest < points || *rest > points + 1) {
    return false;
  }
  others_ = *rest - points;
  const std::size_t cells_before = cells.size();
  const std::size_t items_before = cells.connectivity.size();
  const auto make_room = [&](std::size_t items) {
    shared_resize(cells.connectivity, items_before + items, cells.offsets, cells_before + count + 1,
                  plain_.workers().workers);
    shared_resize(cells.types, cells_before + count, plain_.workers().workers);
  };
  const auto read_part = [&](PlainNumbers& numbers, const PlainListRows::Part& part) {
    std::size_t item = part.first_item;
    const bool read = read_plain_part(numbers, part.first, part.last, [&](PlainNumbers& row_numbers, std::size_t row) {
      Cell cell;
      if (!read_cell(row_numbers, of, {"element", row, count}, cell) || cell.points > part.last_item - item) {
        return false;
      }
      for (std::size_t corner = 0; corner < cell.points; ++corner) {
        cells.connectivity[items_before + item++] = cell.vertices.at(corner);
      }
      cells.offsets[cells_before + row + 1] = static_cast<std::int64_t>(items_before + item);
      cells.types[cells_before + row] = static_cast<std::uint8_t>(cell.type);
      return true;
    });
    return read && item == part.last_item;
  };
  // Where types differ: this looks at all of the rest of the file, which pays for large sections only, and may not be
  // done for each of many small ones.
  constexpr std::size_t least_row = 8;
  const bool is_large = count >= (scanner_.text().size() - offset) / 16 / least_row;
  const auto end = read_plain_lists(plain_, offset, count, {points, others_}, is_large, make_room, read_part);
  if (end) {
    scanner_.resume(end->last_number, end->offset);
  } else {
    cells.connectivity.resize(items_before);
    cells.offsets.resize(cells_before + 1);
    cells.types.resize(cells_before);
  }
  return end.has_value();
}

}  // namespace trismooth

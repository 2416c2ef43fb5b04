// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/triangle/triangle_rows.h"

#include <string>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/text/careful_numbers.h"

namespace trismooth {

namespace {

/// Reads one row after another.
class TriangleRows {
 public:
  TriangleRows(std::size_t count, const TriangleColumns& columns, std::string_view row_name, TriangleTable& table)
      : count_(count), columns_(columns), row_name_(row_name), table_(table) {}

  /// From PlainNumbers or CarefulNumbers.
  template <class Numbers>
  bool read(Numbers& numbers, std::size_t row) const {
    const std::int64_t expected = table_.first_number + static_cast<std::int64_t>(row);
    std::int64_t number = 0;
    if (!numbers.next_index(number, "the number of a row", expected, expected, [&](std::string_view token) {
          return in_row(row) + "expected its number " + std::to_string(expected) + ", got " + quoted(token);
        })) {
      return false;
    }
    for (std::size_t i = columns_.reals_before * row; i < columns_.reals_before * (row + 1); ++i) {
      if (!next_real(numbers, row, table_.reals_before[i], "a coordinate")) {
        return false;
      }
      table_.offsets[i] = numbers.token_offset();
    }
    for (std::size_t i = columns_.indices * row; i < columns_.indices * (row + 1); ++i) {
      std::int64_t node = 0;
      if (!has_more(numbers, row, "a node") ||
          !numbers.next_whole(node, "a node", columns_.first_node, columns_.last_node)) {
        return false;
      }
      table_.indices[i] = static_cast<std::int32_t>(node - columns_.first_node);
    }
    for (std::size_t i = columns_.reals * row; i < columns_.reals * (row + 1); ++i) {
      if (!next_real(numbers, row, table_.reals[i], "an attribute")) {
        return false;
      }
    }
    for (std::size_t i = columns_.integers * row; i < columns_.integers * (row + 1); ++i) {
      if (!has_more(numbers, row, "a boundary marker") ||
          !numbers.next_whole(table_.integers[i], "a boundary marker")) {
        return false;
      }
    }
    return numbers.at_end_of_line() || numbers.fail_at_next("the end of the line", [&](std::string_view rest) {
      return in_row(row) + "expected the end of the line behind " + std::to_string(1 + columns_.size()) +
             " numbers, got " + quoted(rest);
    });
  }

 private:
  template <class Numbers>
  bool next_real(Numbers& numbers, std::size_t row, double& value, std::string_view what) const {
    return has_more(numbers, row, what) && numbers.next_real(value, what);
  }

  template <class Numbers>
  bool has_more(Numbers& numbers, std::size_t row, std::string_view what) const {
    return !numbers.at_end_of_line() || numbers.fail([&](std::string_view /*token*/) {
      return in_row(row) + "expected " + std::string(what) + ", got the end of the line: the file declares " +
             std::to_string(1 + columns_.size()) + " numbers a row";
    });
  }

  std::string in_row(std::size_t row) const {
    return std::string(row_name_) + " " + std::to_string(row + 1) + " of " + std::to_string(count_) + ": ";
  }

  std::size_t count_;
  const TriangleColumns& columns_;
  std::string_view row_name_;
  TriangleTable& table_;
};

}  // namespace

TriangleTable read_triangle_rows(TextScanner& scanner, std::size_t count, const TriangleColumns& columns,
                                 std::string_view row_name, const FileWorkers& workers) {
  TriangleTable table;
  shared_resize(table.reals_before, columns.reals_before * count, table.offsets, columns.reals_before * count,
                workers.workers);
  shared_resize(table.indices, columns.indices * count, table.reals, columns.reals * count, workers.workers);
  table.integers.resize(columns.integers * count);
  if (count == 0) {
    return table;
  }
  table.first_number = scanner.peek_token() == "0" ? 0 : 1;
  PlainRows plain(scanner.text(), workers);
  const TriangleRows rows(count, columns, row_name, table);
  read_rows(
      plain, scanner, count, 1 + columns.size(), "rows",
      [&rows](auto& numbers, std::size_t row) { return rows.read(numbers, row); },
      ": the file is cut off, or the count is wrong");
  return table;
}

}  // namespace trismooth

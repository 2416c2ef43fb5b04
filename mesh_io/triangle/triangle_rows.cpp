#include "trismooth/mesh_io/triangle/triangle_rows.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// Reads rows of plain numbers; false where one is not.
class PlainTriangleRows {
 public:
  PlainTriangleRows(const TriangleColumns& columns, TriangleTable& table) : columns_(columns), table_(table) {}

  bool read(PlainNumbers& numbers, std::size_t first, std::size_t last) const {
    for (std::size_t row = first; row < last; ++row) {
      if (!read_row(numbers, row)) {
        return false;
      }
    }
    return true;
  }

 private:
  bool read_row(PlainNumbers& numbers, std::size_t row) const {
    std::int64_t number = 0;
    if (!numbers.next(number) || number != table_.first_number + static_cast<std::int64_t>(row)) {
      return false;
    }
    for (std::size_t i = columns_.reals_before * row; i < columns_.reals_before * (row + 1); ++i) {
      if (!next_real(numbers, table_.reals_before[i])) {
        return false;
      }
      table_.offsets[i] = numbers.token_offset();
    }
    for (std::size_t i = columns_.indices * row; i < columns_.indices * (row + 1); ++i) {
      std::int64_t node = 0;
      if (numbers.at_end_of_line() || !numbers.next(node) || node < columns_.first_node || node > columns_.last_node) {
        return false;
      }
      table_.indices[i] = static_cast<std::int32_t>(node - columns_.first_node);
    }
    for (std::size_t i = columns_.reals * row; i < columns_.reals * (row + 1); ++i) {
      if (!next_real(numbers, table_.reals[i])) {
        return false;
      }
    }
    for (std::size_t i = columns_.integers * row; i < columns_.integers * (row + 1); ++i) {
      if (numbers.at_end_of_line() || !numbers.next(table_.integers[i])) {
        return false;
      }
    }
    return numbers.at_end_of_line();
  }

  static bool next_real(PlainNumbers& numbers, double& value) {
    return !numbers.at_end_of_line() && numbers.next(value) && std::isfinite(value);
  }

  const TriangleColumns& columns_;
  TriangleTable& table_;
};

/// Reads rows token by token, and says what is wrong with them.
class CarefulTriangleRows {
 public:
  CarefulTriangleRows(TextScanner& scanner, std::size_t count, const TriangleColumns& columns,
                      std::string_view row_name, TriangleTable& table)
      : scanner_(scanner), count_(count), columns_(columns), row_name_(row_name), table_(table) {}

  void read() {
    for (row_ = 0; row_ < count_; ++row_) {
      read_row();
    }
  }

 private:
  void read_row() {
    if (scanner_.at_end()) {
      scanner_.fail("expected " + std::to_string(count_) + " rows, got " + std::to_string(row_) +
                    ": the file is cut off, or the count is wrong");
    }
    const std::string_view token = scanner_.next_token("the number of a row");
    const std::int64_t expected = table_.first_number + static_cast<std::int64_t>(row_);
    if (parse_integer(token) != expected) {
      fail("expected its number " + std::to_string(expected) + ", got " + quoted(token));
    }
    for (std::size_t i = columns_.reals_before * row_; i < columns_.reals_before * (row_ + 1); ++i) {
      table_.reals_before[i] = next_real("a coordinate");
      table_.offsets[i] = scanner_.token_offset();
    }
    for (std::size_t i = columns_.indices * row_; i < columns_.indices * (row_ + 1); ++i) {
      table_.indices[i] = static_cast<std::int32_t>(next_integer("a node", columns_.first_node, columns_.last_node) -
                                                    columns_.first_node);
    }
    for (std::size_t i = columns_.reals * row_; i < columns_.reals * (row_ + 1); ++i) {
      table_.reals[i] = next_real("an attribute");
    }
    for (std::size_t i = columns_.integers * row_; i < columns_.integers * (row_ + 1); ++i) {
      table_.integers[i] = static_cast<std::int32_t>(next_integer(
          "a boundary marker", std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
    }
    if (!scanner_.at_end_of_line()) {
      const std::string_view rest = scanner_.next_token("the end of the line");
      fail("expected the end of the line behind " + std::to_string(1 + columns_.size()) + " numbers, got " +
           quoted(rest));
    }
  }

  double next_real(std::string_view what) {
    require_more(what);
    return scanner_.next_double(what);
  }

  std::int64_t next_integer(std::string_view what, std::int64_t least, std::int64_t most) {
    require_more(what);
    return scanner_.next_integer(what, least, most);
  }

  void require_more(std::string_view what) {
    if (scanner_.at_end_of_line()) {
      fail("expected " + std::string(what) + ", got the end of the line: the file declares " +
           std::to_string(1 + columns_.size()) + " numbers a row");
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    scanner_.fail(std::string(row_name_) + " " + std::to_string(row_ + 1) + " of " + std::to_string(count_) + ": " +
                  message);
  }

  TextScanner& scanner_;
  std::size_t count_;
  const TriangleColumns& columns_;
  std::string_view row_name_;
  TriangleTable& table_;
  std::size_t row_ = 0;
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
  PlainRows rows(scanner.text(), workers);
  const PlainTriangleRows plain(columns, table);
  if (const auto end = rows.read(scanner.offset(), count, 1 + columns.size(),
                                 [&plain](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                                   return plain.read(numbers, first, last);
                                 })) {
    scanner.resume(end->last_number, end->offset);
  } else {
    CarefulTriangleRows(scanner, count, columns, row_name, table).read();
  }
  return table;
}

}  // namespace trismooth

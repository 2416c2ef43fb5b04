// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/plain_rows.h"

namespace trismooth {

/// Reads sections of a text whose rows, a line each, are a list of any length with its length in front of it, and
/// equally many numbers beside it: in parts, by all workers, as PlainRows does.
class PlainListRows {
 public:
  /// What a part holds: rows [first, last), and of all items of all lists those in [first_item, last_item).
  struct Part {
    std::size_t first;
    std::size_t last;
    std::size_t first_item;
    std::size_t last_item;
  };

  /// Looks for `rows` rows, 1 or more, with `beside` numbers beside each list and its length, in the lines behind
  /// `offset`, where a line ends or begins. `text` must outlive the object.
  PlainListRows(std::string_view text, std::size_t offset, std::size_t rows, std::size_t beside,
                const FileWorkers& workers);

  /// The items of all lists; nothing where there are too few rows or numbers.
  std::optional<std::size_t> items() const { return items_; }

  /// Calls body(numbers, part) for parts of the rows, in any order, on any worker: it reads these rows from `numbers`,
  /// each up to the end of its line, and answers false where it cannot, and where there would be more items than it
  /// should find. Nothing where any part could not be read. Only where items() is known.
  template <class Body>
  std::optional<PlainRows::End> read(const Body& body) const {
    PlainRows::End end{};  // set by the one part that holds the last row
    const bool plain = lines_.all_of([&](std::size_t number) {
      const Part& part = parts_[number];
      if (part.first == part.last) {
        return true;
      }
      // Rows that are as many as the lines, each up to the end of a line, with no more numbers than the lines, are a
      // line each.
      PlainNumbers numbers(text_, lines_.begin(number));
      const bool read = body(numbers, part);
      if (part.last == rows_) {
        end = {numbers.token_offset(), numbers.offset()};
      }
      return read;
    });
    return plain ? std::optional(end) : std::nullopt;
  }

 private:
  std::string_view text_;
  LineParts lines_;
  std::size_t rows_;
  std::vector<Part> parts_;
  std::optional<std::size_t> items_;
};

/// Rows that are a list each, with equally many numbers beside it.
struct PlainListShape {
  std::size_t items = 0;   ///< of the first list
  std::size_t beside = 0;  ///< numbers beside a list and the one that says how long it is
};

/// Reads `count` such rows, 1 or more, that begin at `offset`: as if all lists were as long as the first one, and,
/// where that fails and `may_differ`, as rows that are a line each. Calls make_room(items of all lists), once or twice,
/// and read_part(numbers, part) as PlainListRows does; that answers false too where the part has more or fewer items.
/// What room was made stays where the answer is nothing.
template <class MakeRoom, class ReadPart>
std::optional<PlainRows::End> read_plain_lists(PlainRows& rows, std::size_t offset, std::size_t count,
                                               const PlainListShape& shape, bool may_differ, const MakeRoom& make_room,
                                               const ReadPart& read_part) {
  if (rows.workers().part_bytes == FileWorkers::serial) {
    return std::nullopt;
  }
  std::optional<PlainRows::End> end;
  const std::size_t columns = 1 + shape.items + shape.beside;
  if (rows.has_room(offset, count, columns)) {
    make_room(shape.items * count);
    end = rows.read(offset, count, columns, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
      return read_part(numbers, PlainListRows::Part{first, last, shape.items * first, shape.items * last});
    });
  }
  if (!end && may_differ) {
    const PlainListRows lists(rows.text(), offset, count, shape.beside, rows.workers());
    if (lists.items()) {
      make_room(*lists.items());
      end = lists.read(read_part);
    }
  }
  return end;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

/// Reads sections of a text that are rows of equally many plain numbers (see PlainNumbers), in parts, by all workers.
/// A codec tries it where a section begins, and reads the section number by number where that fails: that a text has
/// anything unusual in it, or is broken, is found and said there alone.
class PlainRows {
 public:
  /// Where a section ended: byte offsets of its last number, and behind the last row.
  struct End {
    std::size_t last_number;
    std::size_t offset;
  };

  /// `text` must outlive the object.
  PlainRows(std::string_view text, const FileWorkers& workers) : text_(text), workers_(workers) {}

  std::string_view text() const { return text_; }
  const FileWorkers& workers() const { return workers_; }

  /// Whether so many numbers may stand behind `offset`: each takes a digit and a separator, but for the separator at
  /// the end of the text. `columns` is 1 or more.
  bool has_room(std::size_t offset, std::size_t rows, std::size_t columns) const {
    return rows <= (text_.size() - offset + 1) / 2 / columns;
  }

  /// Reads `rows` rows of `columns` numbers from `offset` on, which is at no token or at the start of one. Calls
  /// body(numbers, first, last) for parts of the rows, in any order, on any worker: it reads rows first to last - 1
  /// from `numbers` and answers false where it cannot. Nothing where any part could not be read; what the body has
  /// written so far is of no meaning then. `rows` and `columns` are 1 or more.
  template <class Body>
  std::optional<End> read(std::size_t offset, std::size_t rows, std::size_t columns, const Body& body) {
    if (workers_.part_bytes == FileWorkers::serial) {
      return std::nullopt;
    }
    if (text_.size() - offset <= workers_.part_bytes) {
      PlainNumbers numbers(text_, offset);
      return body(numbers, std::size_t{0}, rows) ? std::optional(end_of(numbers)) : std::nullopt;
    }
    const auto call = [](const void* object, PlainNumbers& numbers, std::size_t first, std::size_t last) {
      return (*static_cast<const Body*>(object))(numbers, first, last);
    };
    return read_parts(offset, rows, columns, {&body, call});
  }

 private:
  /// A body of any type: what calls it is compiled once.
  struct AnyBody {
    const void* object;
    bool (*call)(const void* object, PlainNumbers& numbers, std::size_t first, std::size_t last);
  };

  static End end_of(const PlainNumbers& numbers) { return {numbers.token_offset(), numbers.offset()}; }
  std::optional<End> read_parts(std::size_t offset, std::size_t rows, std::size_t columns, const AnyBody& body);
  void count_tokens_of_parts();

  std::string_view text_;
  FileWorkers workers_;
  /// How many tokens begin before an offset.
  struct Counted {
    std::size_t offset;
    std::uint64_t tokens;
  };

  Counted counted_{0, 0};                     ///< where the last section began
  std::vector<std::uint64_t> tokens_before_;  ///< each part of the text, and all of it; empty before the first use
};

}  // namespace trismooth

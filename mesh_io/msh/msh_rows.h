#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_tags.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"
#include "trismooth/mesh_io/text/plain_rows.h"

namespace trismooth {

/// A list of rows of equally many numbers, as MSH files hold them.
struct MshRowLayout {
  std::size_t rows = 0;
  std::size_t numbers = 0;  ///< of a row
  std::size_t bytes = 0;    ///< of a row in a binary file
};

/// Reads such lists by all workers, of files of either kind, where nothing is unusual in them.
class MshRows {
 public:
  MshRows(MshInput& input, const FileWorkers& workers)
      : input_(input), workers_(workers), plain_(input.bytes(), workers) {}

  /// Calls body(numbers, first, last) for parts of the rows behind the place where the input stands, which reads rows
  /// first to last - 1 from `numbers` (PlainNumbers or BinaryNumbers) and answers false where it cannot. Where all were
  /// read the input stands behind them and the answer is true; else nothing has changed.
  template <class Body>
  bool read(const MshRowLayout& layout, const Body& body) {
    if (input_.header().binary) {
      return read_binary(layout, body);
    }
    if (layout.rows == 0) {
      return false;
    }
    const auto end = plain_.read(input_.offset(), layout.rows, layout.numbers, body);
    if (end) {
      input_.text().resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  /// The same of binary files alone: `numbers` are BinaryNumbers.
  template <class Body>
  bool read_binary(const MshRowLayout& layout, const Body& body) {
    if (workers_.part_bytes == FileWorkers::serial || layout.rows == 0 ||
        layout.rows > input_.bytes_left() / layout.bytes) {
      return false;
    }
    const std::size_t begin = input_.offset();
    const bool all = all_file_blocks(workers_, layout.rows, layout.bytes, [&](std::size_t first, std::size_t last) {
      BinaryNumbers numbers(input_.bytes(), begin + first * layout.bytes, input_.header().swapped);
      return body(numbers, first, last);
    });
    if (all) {
      input_.seek(begin + layout.rows * layout.bytes);
    }
    return all;
  }

  /// The same for rows of a text that are a list each (see read_plain_lists).
  template <class MakeRoom, class ReadPart>
  bool read_lists(std::size_t rows, const PlainListShape& shape, const MakeRoom& make_room, const ReadPart& read_part) {
    const auto end = read_plain_lists(plain_, input_.offset(), rows, shape, true, make_room, read_part);
    if (end) {
      input_.text().resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  void seek(std::size_t offset) { input_.seek(offset); }
  const FileWorkers& workers() const { return workers_; }

 private:
  MshInput& input_;
  FileWorkers workers_;
  PlainRows plain_;
};

/// As what a tag is read. Before version 4.1 all numbers are ints, those of text too.
enum class MshTagKind : std::uint8_t { int32, uint32, int64 };

inline MshTagKind tag_kind_of(const MshHeader& header) {
  return header.version < 41                       ? MshTagKind::int32
         : header.binary && header.size_bytes == 4 ? MshTagKind::uint32
                                                   : MshTagKind::int64;
}

/// Bytes of a tag in a binary file.
constexpr std::size_t tag_bytes(MshTagKind kind) {
  return kind == MshTagKind::int64 ? 8 : 4;
}

/// Calls body(T{}) with the type that tags of that kind are read as, and answers what it does.
template <class Body>
bool visit_tag_type(MshTagKind kind, const Body& body) {
  switch (kind) {
    case MshTagKind::int32:
      return body(std::int32_t{});
    case MshTagKind::uint32:
      return body(std::uint32_t{});
    default:
      return body(std::int64_t{});
  }
}

/// The next tag of PlainNumbers or BinaryNumbers, written as a Tag; false where it cannot be read or is negative.
template <class Tag, class Numbers>
bool next_tag(Numbers& numbers, std::int64_t& tag) {
  Tag value{};
  const bool read = numbers.next(value);
  tag = static_cast<std::int64_t>(value);
  return read && tag >= 0;
}

/// The next tags, of as many things as there are places; nothing is judged but that they can be read.
template <class Tag, std::size_t count, class Numbers>
bool next_tags(Numbers& numbers, std::array<Tag, count>& tags) {
  if constexpr (std::is_same_v<Numbers, BinaryNumbers>) {
    return numbers.next_all(std::span(tags));
  } else {
    return std::ranges::all_of(tags, [&numbers](Tag& tag) { return numbers.next(tag); });
  }
}

/// The tags that begin the rows of a list: those of one that counts on take no memory.
class MshRowTags {
 public:
  MshRowTags(MshTagKind kind, std::size_t rows) : kind_(kind), rows_(rows) {}

  /// Reads the rows of the layout, each a tag and what rest(numbers, row, type) reads behind it, where a tag is of the
  /// type of `type`, and appends the tags to `tags`. False where anything is unusual: nothing has changed then.
  template <class Rest>
  bool read(MshRows& rows, const MshInput& input, const MshRowLayout& layout, MshTags& tags, const Rest& rest) {
    return read(rows, input, tags, [&](auto type) {
      return rows.read(layout, [&](auto& numbers, std::size_t first, std::size_t last) {
        bool plain = true;
        for (std::size_t row = first; row < last && plain; ++row) {
          plain = next<decltype(type)>(numbers, row) && rest(numbers, row, type);
        }
        return plain;
      });
    });
  }

  /// The same where read_rows(type) reads all rows, once or twice: it takes the tag of each by next<type of a tag>().
  template <class ReadRows>
  bool read(MshRows& rows, const MshInput& input, MshTags& tags, const ReadRows& read_rows) {
    return visit_tag_type(kind_, [&](auto type) {
      using Tag = decltype(type);
      const bool begun = input.header().binary
                             ? begin<Tag>(BinaryNumbers(input.bytes(), input.offset(), input.header().swapped))
                             : begin<Tag>(PlainNumbers(input.bytes(), input.offset()));
      if (!begun) {
        return false;
      }
      const std::size_t offset = input.offset();
      bool plain = read_rows(type);
      if (plain && !counts_on_) {
        rows.seek(offset);
        shared_resize(listed_, rows_, rows.workers().workers);
        plain = read_rows(type);
      }
      if (plain && listed_.empty()) {
        tags.add_run(first_, rows_);
      } else if (plain) {
        tags.add(listed_);
      }
      return plain;
    });
  }

  /// The tag of that row, which is the next number. False where it cannot be read.
  template <class Tag, class Numbers>
  bool next(Numbers& numbers, std::size_t row) {
    std::int64_t tag = 0;
    if (!next_tag<Tag>(numbers, tag)) {
      return false;
    }
    if (!listed_.empty()) {
      listed_[row] = tag;
    } else if (static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_) != row) {
      counts_on_.store(false, std::memory_order_relaxed);
    }
    return true;
  }

 private:
  template <class Tag, class Numbers>
  bool begin(Numbers numbers) {
    return next_tag<Tag>(numbers, first_);
  }

  MshTagKind kind_;
  std::size_t rows_;
  std::int64_t first_ = 0;
  std::atomic<bool> counts_on_ = true;
  std::vector<std::int64_t> listed_;
};

/// Makes room for more values at the end of two vectors, in steps that double, by all workers.
template <class A, class B>
void grow_shared(std::vector<A>& a, std::size_t size_of_a, std::vector<B>& b, std::size_t size_of_b, Workers& workers) {
  const auto reserve = [&workers](auto& values, std::size_t size) {
    if (size > values.capacity()) {
      shared_reserve(values, std::max(size, 2 * values.capacity()), workers);
    }
  };
  reserve(a, size_of_a);
  reserve(b, size_of_b);
  shared_resize(a, size_of_a, b, size_of_b, workers);
}

}  // namespace trismooth

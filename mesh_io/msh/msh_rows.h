#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_tags.h"
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
    if (workers_.part_bytes == FileWorkers::serial || layout.rows == 0) {
      return false;
    }
    const std::size_t begin = input_.offset();
    if (!input_.header().binary) {
      const auto end = plain_.read(begin, layout.rows, layout.numbers, body);
      if (end) {
        input_.text().resume(end->last_number, end->offset);
      }
      return end.has_value();
    }
    if (layout.rows > input_.bytes_left() / layout.bytes) {
      return false;
    }
    const bool all = all_file_blocks(workers_, layout.rows, layout.bytes, [&](std::size_t first, std::size_t last) {
      BinaryNumbers numbers(input_.bytes(), begin + first * layout.bytes, input_.header().swapped);
      return body(numbers, first, last);
    });
    if (all) {
      input_.seek(begin + layout.rows * layout.bytes);
    }
    return all;
  }

  void seek(std::size_t offset) { input_.seek(offset); }
  const FileWorkers& workers() const { return workers_; }

 private:
  MshInput& input_;
  FileWorkers workers_;
  PlainRows plain_;
};

/// The type whose numbers from 0 on are tags; a tag in a binary file is one of them.
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

/// The next tag of PlainNumbers or BinaryNumbers; false where it cannot be read or is none.
template <class Numbers>
bool next_tag(Numbers& numbers, MshTagKind kind, std::int64_t& tag) {
  const auto next_as = [&](auto value) {
    const bool read = numbers.next(value);
    tag = static_cast<std::int64_t>(value);
    return read && tag >= 0;
  };
  switch (kind) {
    case MshTagKind::int32:
      return next_as(std::int32_t{});
    case MshTagKind::uint32:
      return next_as(std::uint32_t{});
    default:
      return next_as(std::int64_t{});
  }
}

/// The tags that begin the rows of a list: those of one that counts on take no memory.
class MshRowTags {
 public:
  MshRowTags(MshTagKind kind, std::size_t rows) : kind_(kind), rows_(rows) {}

  /// Reads the rows of the layout, each a tag and what rest(numbers, row) reads behind it, and appends the tags to
  /// `tags`. False where anything is unusual: nothing has changed then.
  template <class Rest>
  bool read(MshRows& rows, const MshInput& input, const MshRowLayout& layout, MshTags& tags, const Rest& rest) {
    const bool begun = input.header().binary
                           ? begin(BinaryNumbers(input.bytes(), input.offset(), input.header().swapped))
                           : begin(PlainNumbers(input.bytes(), input.offset()));
    if (!begun) {
      return false;
    }
    const auto read_rows = [&] {
      return rows.read(layout, [&](auto& numbers, std::size_t first, std::size_t last) {
        bool plain = true;
        for (std::size_t row = first; row < last && plain; ++row) {
          plain = next(numbers, row) && rest(numbers, row);
        }
        return plain;
      });
    };
    const std::size_t offset = input.offset();
    bool plain = read_rows();
    if (plain && !counts_on_) {
      rows.seek(offset);
      shared_resize(listed_, rows_, rows.workers().workers);
      plain = read_rows();
    }
    if (plain && listed_.empty()) {
      tags.add_run(first_, rows_);
    } else if (plain) {
      tags.add(listed_);
    }
    return plain;
  }

 private:
  template <class Numbers>
  bool begin(Numbers numbers) {
    return next_tag(numbers, kind_, first_);
  }

  template <class Numbers>
  bool next(Numbers& numbers, std::size_t row) {
    std::int64_t tag = 0;
    if (!next_tag(numbers, kind_, tag)) {
      return false;
    }
    if (!listed_.empty()) {
      listed_[row] = tag;
    } else if (static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_) != row) {
      counts_on_.store(false, std::memory_order_relaxed);
    }
    return true;
  }

  MshTagKind kind_;
  std::size_t rows_;
  std::int64_t first_ = 0;
  std::atomic<bool> counts_on_ = true;
  std::vector<std::int64_t> listed_;
};

/// Makes room for more values at the end, in steps that double, by all workers.
template <class T>
void grow_shared(std::vector<T>& values, std::size_t size, Workers& workers) {
  if (size > values.capacity()) {
    shared_reserve(values, std::max(size, 2 * values.capacity()), workers);
  }
  values.resize(size);
}

}  // namespace trismooth

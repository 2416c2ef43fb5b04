// SPDX-License-Identifier: BSD-3-Clause
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
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_rows.h"
#include "trismooth/mesh_io/msh/msh_tags.h"
#include "trismooth/mesh_io/text/decimal_counter.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

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
  /// The tags of rows that one worker reads, one behind the other.
  template <class Tag>
  class Part {
   public:
    Part(MshRowTags& all, std::size_t first)
        : all_(all),
          row_(first),
          lists_(!all.listed_.empty()),
          counter_(static_cast<std::int64_t>(static_cast<std::uint64_t>(all.first_) + first)) {}

    /// The tag of the next row, which is the next number. False where it cannot be read.
    template <class Numbers>
    bool next(Numbers& numbers) {
      if constexpr (std::is_same_v<Numbers, PlainNumbers>) {
        if (!lists_) {
          const bool counts_on = numbers.next_is(counter_);
          counter_.increment();
          if (counts_on) {
            ++row_;
            return true;
          }
        }
      }
      std::int64_t tag = 0;
      if (!next_tag<Tag>(numbers, tag)) {
        return false;
      }
      if (lists_) {
        all_.listed_[row_] = tag;
      } else if (static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(all_.first_) != row_) {
        all_.counts_on_.store(false, std::memory_order_relaxed);
      }
      ++row_;
      return true;
    }

   private:
    MshRowTags& all_;
    std::size_t row_;
    bool lists_;
    DecimalCounter counter_;
  };

  MshRowTags(MshTagKind kind, std::size_t rows) : kind_(kind), rows_(rows) {}

  /// Reads the rows of the layout, each a tag and what rest(numbers, row, type) reads behind it, where a tag is of the
  /// type of `type`, and appends the tags to `tags`. False where anything is unusual: nothing has changed then.
  template <class Rest>
  bool read(MshRows& rows, const MshInput& input, const MshRowLayout& layout, MshTags& tags, const Rest& rest) {
    return read(rows, input, tags, [&](auto type) {
      return rows.read(layout, [&](auto& numbers, std::size_t first, std::size_t last) {
        Part<decltype(type)> part(*this, first);
        bool plain = true;
        for (std::size_t row = first; row < last && plain; ++row) {
          plain = part.next(numbers) && rest(numbers, row, type);
        }
        return plain;
      });
    });
  }

  /// Reads rows and appends their tags to `tags`: read_rows(type) reads all of them, once or twice, and takes the tags
  /// by Part<type of a tag>. False where anything is unusual: nothing has changed then.
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

}  // namespace trismooth

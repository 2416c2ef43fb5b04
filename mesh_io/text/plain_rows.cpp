// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/plain_rows.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "trismooth/mesh_io/text/token_count.h"

namespace trismooth {

namespace {

std::size_t divided_up(std::size_t a, std::size_t b) {
  return a / b + (a % b == 0 ? 0 : 1);
}

}  // namespace

void PlainRows::count_tokens_of_parts() {
  const std::size_t parts = divided_up(text_.size(), workers_.part_bytes);
  tokens_before_.resize(parts + 1);
  workers_.workers.for_blocks(static_cast<std::int64_t>(parts), 1, [this](std::int64_t first, std::int64_t last) {
    for (auto part = static_cast<std::size_t>(first); part < static_cast<std::size_t>(last); ++part) {
      const std::size_t begin = part * workers_.part_bytes;
      tokens_before_[part + 1] = count_tokens(text_, begin, std::min(begin + workers_.part_bytes, text_.size()));
    }
  });
  std::partial_sum(tokens_before_.begin(), tokens_before_.end(), tokens_before_.begin());
}

std::optional<PlainRows::End> PlainRows::read_parts(std::size_t offset, std::size_t rows, std::size_t columns,
                                                    const AnyBody& body) {
  if (offset > 0 && !is_white_space(text_[offset - 1]) && !is_white_space(text_[offset])) {
    return std::nullopt;  // within a token: none begins there
  }
  if (tokens_before_.empty()) {
    count_tokens_of_parts();
  }
  const std::size_t part_bytes = workers_.part_bytes;
  const std::size_t first_part = offset / part_bytes;
  // Sections may be many and small: nothing is counted for each of them again.
  const std::size_t part_begin = first_part * part_bytes;
  const bool goes_on = counted_.offset >= part_begin && counted_.offset <= offset;
  counted_ = {offset, goes_on ? counted_.tokens + count_tokens(text_, counted_.offset, offset)
                              : tokens_before_[first_part] + count_tokens(text_, part_begin, offset)};
  const std::uint64_t before = counted_.tokens;
  if ((tokens_before_.back() - before) / columns < rows) {
    return std::nullopt;
  }
  const std::uint64_t behind = before + rows * columns;
  const auto last_part = static_cast<std::size_t>(
      std::lower_bound(tokens_before_.begin(), tokens_before_.end(), behind) - tokens_before_.begin());
  // The rows whose first number is in the part or behind it.
  const auto first_row_of = [&](std::size_t part) {
    const std::uint64_t tokens = tokens_before_[part];
    return tokens <= before ? std::size_t{0} : std::min(rows, divided_up(tokens - before, columns));
  };
  std::atomic<bool> failed = false;
  End end{};  // set by the one part that holds the last row
  workers_.workers.for_blocks(
      static_cast<std::int64_t>(last_part - first_part), 1, [&](std::int64_t from, std::int64_t to) {
        for (std::size_t part = first_part + static_cast<std::size_t>(from);
             part < first_part + static_cast<std::size_t>(to) && !failed; ++part) {
          const std::size_t first = part == first_part ? 0 : first_row_of(part);
          const std::size_t last = first_row_of(part + 1);
          if (first >= last) {
            continue;
          }
          // Of a token that goes on here from the part before, that part takes care.
          std::size_t begin = part == first_part ? offset : part * part_bytes;
          if (part != first_part && !is_white_space(text_[begin - 1])) {
            begin += static_cast<std::size_t>(
                std::find_if(text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.end(), &is_white_space) -
                (text_.begin() + static_cast<std::ptrdiff_t>(begin)));
          }
          PlainNumbers numbers(text_, begin);
          const std::uint64_t tokens = part == first_part ? before : tokens_before_[part];
          if (!numbers.skip(before + first * columns - tokens) || !body.call(body.object, numbers, first, last)) {
            failed = true;
          } else if (last == rows) {
            end = end_of(numbers);
          }
        }
      });
  return failed ? std::nullopt : std::optional(end);
}

}  // namespace trismooth

#include "trismooth/mesh_io/text/plain_rows.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <numeric>

namespace trismooth {

namespace {

/// The highest bit of every byte of eight that is white space (see is_white_space).
std::uint64_t white_space_in(const char* bytes) {
  constexpr std::uint64_t each = 0x0101010101010101U;
  constexpr std::uint64_t high = 0x80 * each;
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof(word));
  const std::uint64_t low = word & ~high;
  const std::uint64_t is_no_blank = (low ^ (' ' * each)) + 0x7f * each;
  const std::uint64_t from_tab = low + (0x80 - '\t') * each;
  const std::uint64_t behind_return = low + (0x80 - '\r' - 1) * each;
  return (~is_no_blank | (from_tab & ~behind_return)) & ~word & high;
}

/// Tokens that begin in text[begin, end): eight bytes at a time, without branches.
std::uint64_t count_tokens_in(std::string_view text, std::size_t begin, std::size_t end) {
  constexpr std::size_t most_rounds = 255;  // of counting in one byte
  constexpr std::uint64_t even_bytes = 0x00FF00FF00FF00FFU;
  std::uint64_t count = 0;
  if (begin == 0 && begin < end) {
    count = is_white_space(text[0]) ? 0 : 1;
    begin = 1;
  }
  while (end - begin >= 8) {
    std::uint64_t counts = 0;  // one in each byte
    const std::size_t rounds = std::min(most_rounds, (end - begin) / 8);
    for (std::size_t round = 0; round < rounds; ++round) {
      const char* const at = text.data() + begin + 8 * round;
      counts += (white_space_in(at - 1) & ~white_space_in(at)) >> 7;
    }
    begin += 8 * rounds;
    const std::uint64_t in_pairs = (counts & even_bytes) + (counts >> 8 & even_bytes);
    count += in_pairs * 0x0001000100010001U >> 48;
  }
  for (; begin < end; ++begin) {
    count += is_white_space(text[begin - 1]) && !is_white_space(text[begin]) ? 1 : 0;
  }
  return count;
}

std::size_t divided_up(std::size_t a, std::size_t b) {
  return a / b + (a % b == 0 ? 0 : 1);
}

}  // namespace

void PlainRows::count_tokens() {
  const std::size_t parts = divided_up(text_.size(), workers_.part_bytes);
  tokens_before_.resize(parts + 1);
  workers_.workers.for_blocks(static_cast<std::int64_t>(parts), 1, [this](std::int64_t first, std::int64_t last) {
    for (auto part = static_cast<std::size_t>(first); part < static_cast<std::size_t>(last); ++part) {
      const std::size_t begin = part * workers_.part_bytes;
      tokens_before_[part + 1] = count_tokens_in(text_, begin, std::min(begin + workers_.part_bytes, text_.size()));
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
    count_tokens();
  }
  const std::size_t part_bytes = workers_.part_bytes;
  const std::size_t first_part = offset / part_bytes;
  const std::uint64_t before = tokens_before_[first_part] + count_tokens_in(text_, first_part * part_bytes, offset);
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

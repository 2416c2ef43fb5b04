// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/token_count.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

/// is_white_space() as the compiler turns it into wide registers: 1 or 0, without a branch.
constexpr std::uint8_t white_space_bit(char c) {
  const auto behind_tab = static_cast<std::uint8_t>(c - '\t');
  return static_cast<std::uint8_t>((c == ' ' ? 1 : 0) | (behind_tab <= '\r' - '\t' ? 1 : 0));
}

constexpr std::size_t counted_bytes = 32;  // in one round

/// Tokens that begin in so many rounds, 255 at most, from `bytes` on. There is a byte before the first.
std::uint64_t count_in_rounds(const char* bytes, std::size_t rounds) {
  std::array<std::uint8_t, counted_bytes> counts{};
  for (std::size_t round = 0; round < rounds; ++round) {
    const char* const at = bytes + counted_bytes * round;
    for (std::size_t i = 0; i < counted_bytes; ++i) {
      counts[i] =
          static_cast<std::uint8_t>(counts[i] + (white_space_bit(*(at + i - 1)) & (1 - white_space_bit(at[i]))));
    }
  }
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t count_tokens(std::string_view text, std::size_t begin, std::size_t end) {
  constexpr std::size_t most_rounds = 255;  // of counting in one byte
  std::uint64_t count = 0;
  if (begin == 0 && begin < end) {
    count = is_white_space(text[0]) ? 0 : 1;
    begin = 1;
  }
  while (end - begin >= counted_bytes) {
    const std::size_t rounds = std::min(most_rounds, (end - begin) / counted_bytes);
    count += count_in_rounds(text.data() + begin, rounds);
    begin += counted_bytes * rounds;
  }
  for (; begin < end; ++begin) {
    count += is_white_space(text[begin - 1]) && !is_white_space(text[begin]) ? 1 : 0;
  }
  return count;
}

}  // namespace trismooth

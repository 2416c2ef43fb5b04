#include "trismooth/mesh_io/text/token_count.h"

#include <algorithm>
#include <cstring>

#include "trismooth/mesh_io/text/plain_numbers.h"

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

}  // namespace

// Eight bytes at a time, without branches.
std::uint64_t count_tokens(std::string_view text, std::size_t begin, std::size_t end) {
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

}  // namespace trismooth

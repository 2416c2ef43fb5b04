// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/line_parts.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace trismooth {

std::size_t find_line_end(std::string_view text, std::size_t begin) {
  if constexpr (std::endian::native == std::endian::little) {
    // Eight bytes at a time: those that are 0 after the exclusive or are found by their borrow, the first one for sure.
    constexpr std::uint64_t each = 0x0101010101010101U;
    constexpr std::uint64_t high = 0x80 * each;
    for (; text.size() - begin >= sizeof(std::uint64_t); begin += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, text.data() + begin, sizeof(word));
      const std::uint64_t feed = word ^ ('\n' * each);
      const std::uint64_t carriage_return = word ^ ('\r' * each);
      const std::uint64_t found = ((feed - each) & ~feed) | ((carriage_return - each) & ~carriage_return);
      if ((found & high) != 0) {
        return begin + static_cast<std::size_t>(std::countr_zero(found & high)) / 8;
      }
    }
  }
  while (begin < text.size() && text[begin] != '\n' && text[begin] != '\r') {
    ++begin;
  }
  return begin;
}

LineParts::LineParts(std::string_view text, std::size_t begin, const FileWorkers& workers)
    : workers_(workers.workers), begins_{begin} {
  for (std::size_t at = begin; text.size() - at > workers.part_bytes;) {
    at = std::min(find_line_end(text, at + workers.part_bytes - 1) + 1, text.size());
    begins_.push_back(at);
  }
  if (begins_.back() < text.size()) {
    begins_.push_back(text.size());
  }
}

}  // namespace trismooth

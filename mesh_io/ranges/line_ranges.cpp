// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ranges/line_ranges.h"

#include <algorithm>
#include <atomic>

#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

std::size_t line_begin_from(const InputFile& file, std::size_t offset) {
  constexpr std::size_t step = std::size_t{1} << 16;
  for (std::size_t at = offset - 1;; at += step) {
    const FileBytes bytes = file.read_range(at, at + step);
    const std::size_t end = find_line_end(bytes, 0);
    if (end < bytes.size()) {
      return at + end + 1;
    }
    if (bytes.size() < step) {
      return at + bytes.size();
    }
  }
}

std::uint64_t count_lines_with_tokens(std::string_view text, const FileWorkers& workers) {
  const LineParts parts(text, 0, workers);
  std::atomic<std::uint64_t> count = 0;
  parts.all_of([&](std::size_t part) {
    std::uint64_t lines = 0;
    for (std::size_t at = parts.begin(part); at < parts.end(part); ++at) {
      while (at < parts.end(part) && is_white_space(text[at])) {
        ++at;
      }
      if (at == parts.end(part)) {
        break;
      }
      lines += text[at] == '#' ? 0 : 1;
      at = std::min(find_line_end(text, at), parts.end(part));
    }
    count += lines;
    return true;
  });
  return count;
}

}  // namespace trismooth

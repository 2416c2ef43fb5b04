// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/su2/su2_keyword_line.h"

#include <algorithm>
#include <array>

#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr bool is_of_keyword(char c) {
  return ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_';
}

}  // namespace

std::optional<Su2KeywordLine> parse_su2_keyword_line(std::string_view line) {
  line = line.substr(0, line.find('%'));
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view keyword = trimmed(line.substr(0, equals));
  if (keyword.empty() || !std::ranges::all_of(keyword, &is_of_keyword)) {
    return std::nullopt;
  }
  return Su2KeywordLine{keyword, trimmed(line.substr(equals + 1))};
}

bool recognises_su2(std::string_view bytes) {
  constexpr std::array<std::string_view, 5> first_keywords{"NDIME", "NZONE", "IZONE", "NPOIN", "NELEM"};
  std::size_t at = begin_of_text(bytes);
  while (at < bytes.size()) {
    const std::size_t end = find_line_end(bytes, at);
    const std::string_view line = trimmed(bytes.substr(at, end - at));
    if (!line.empty() && line.front() != '%') {
      const auto found = parse_su2_keyword_line(line);
      return found && std::ranges::find(first_keywords, found->keyword) != first_keywords.end();
    }
    at = end + 1;
  }
  return false;
}

}  // namespace trismooth

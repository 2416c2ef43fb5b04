// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace trismooth {

/// What separates words of a line.
inline constexpr std::string_view blanks = " \t\v\f";

/// Whether it is one of them: quicker than to look it up in the list, which counts where lines are many.
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/// The text without blanks at its ends.
constexpr std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

/// The text without those characters at its ends.
inline std::string_view trimmed(std::string_view text, std::string_view characters) {
  const std::size_t begin = std::min(text.find_first_not_of(characters), text.size());
  return text.substr(begin, text.find_last_not_of(characters) + 1 - begin);
}

/// The text up to the Ctrl-Z with which DOS ended text files, where it has one: nothing but white space is behind it.
constexpr std::string_view without_end_mark(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" \t\v\f\r\n");
  return last != std::string_view::npos && text[last] == '\x1a' ? text.substr(0, last) : text;
}

/// The words of a line.
inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    found.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return found;
}

}  // namespace trismooth

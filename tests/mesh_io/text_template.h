// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// `text` with its '@' replaced by the tokens, in order: files whose coordinates' places are known without any parser.
inline std::string fill(std::string_view text, const std::vector<std::string>& tokens) {
  std::string filled;
  std::size_t next = 0;
  for (const char c : text) {
    if (c == '@') {
      filled += tokens.at(next++);
    } else {
      filled += c;
    }
  }
  return filled;
}

/// The shortest text of a number, by the standard library.
inline std::string shortest(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

/// `text` with every `from` replaced by `to`.
inline std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

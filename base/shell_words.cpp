#include "trismooth/base/shell_words.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace trismooth {

namespace {

bool is_harmless(char c) {
  constexpr std::string_view harmless = "_-+=,./:@%";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         harmless.find(c) != std::string_view::npos;
}

/// Bytes of the printable character of UTF-8 that `text` begins with; 0 where it begins with a control character or
/// with what is no UTF-8 (see The Unicode Standard, table 3-7).
std::size_t printable_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xbf) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) {
    return first >= 0x20 && first != 0x7f ? 1 : 0;
  }
  if (first >= 0xc2 && first <= 0xdf) {
    return follows(1, first == 0xc2 ? 0xa0 : 0x80) ? 2 : 0;  // below that are the control characters C1
  }
  if (first >= 0xe0 && first <= 0xef) {
    return follows(1, first == 0xe0 ? 0xa0 : 0x80, first == 0xed ? 0x9f : 0xbf) && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    return follows(1, first == 0xf0 ? 0x90 : 0x80, first == 0xf4 ? 0x8f : 0xbf) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    if (length == 0) {
      return false;
    }
    text.remove_prefix(length);
  }
  return true;
}

/// Within $'...': three octal digits end by themselves, which a code in hexadecimal does not in every shell.
std::string escaped(std::string_view word) {
  std::string text;
  while (!word.empty()) {
    const std::size_t length = printable_length(word);
    if (length == 0) {
      text += fmt::format("\\{:03o}", static_cast<unsigned char>(word.front()));
    } else if (word.front() == '\'' || word.front() == '\\') {
      text.append("\\").append(1, word.front());
    } else {
      text.append(word.substr(0, length));
    }
    word.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

}  // namespace

std::string shell_word(std::string_view word) {
  // An equals sign in front makes zsh look for a program.
  if (!word.empty() && word.front() != '=' && std::ranges::all_of(word, is_harmless)) {
    return std::string(word);
  }
  if (!is_printable(word)) {
    return "$'" + escaped(word) + "'";
  }
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

std::string shell_command(std::span<const std::string> words) {
  std::string command;
  for (const std::string& word : words) {
    command.append(command.empty() ? "" : " ").append(shell_word(word));
  }
  return command;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/shell_words.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/utf8.h"

namespace trismooth {

namespace {

bool is_harmless(char c) {
  constexpr std::string_view harmless = "_-+=,./:@%";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         harmless.find(c) != std::string_view::npos;
}

/// Bytes of the printable character of UTF-8 that `text` begins with; 0 where it begins with a control character (C0,
/// delete, C1) or with what is no UTF-8.
std::size_t printable_length(std::string_view text) {
  const auto [length, code] = first_utf8_character(text);
  const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  return is_control ? 0 : length;
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
      const unsigned byte = static_cast<unsigned char>(word.front());
      text += '\\';
      for (const unsigned shift : {6U, 3U, 0U}) {
        text += static_cast<char>('0' + (byte >> shift & 7U));
      }
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
  return list_text(words, shell_word, " ");
}

}  // namespace trismooth

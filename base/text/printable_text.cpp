// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/printable_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "trismooth/base/text/utf8.h"

namespace trismooth {

namespace {

bool is_harmful(char32_t code) {
  static constexpr std::array<std::pair<char32_t, char32_t>, 9> ranges{{{0x00, 0x1F},
                                                                        {0x7F, 0x9F},
                                                                        {0x061C, 0x061C},
                                                                        {0x200E, 0x200F},
                                                                        {0x2028, 0x2029},
                                                                        {0x202A, 0x202E},
                                                                        {0x2066, 0x2069},
                                                                        {0xFEFF, 0xFEFF},
                                                                        {0xFFFE, 0xFFFF}}};
  return std::ranges::any_of(ranges, [code](const auto& range) { return range.first <= code && code <= range.second; });
}

std::string escaped(const TextPiece& piece) {
  const bool is_long = piece.is_character && piece.code >= 0x80;
  const char32_t code = is_long ? piece.code : static_cast<unsigned char>(piece.bytes.front());
  std::string text = is_long ? "\\u" : "\\x";
  for (int shift = is_long ? 12 : 4; shift >= 0; shift -= 4) {
    text += "0123456789abcdef"[code >> shift & 0xFU];
  }
  return text;
}

template <class Stays>
std::string with_escapes(std::string_view text, const Stays& stays) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const TextPiece piece = first_piece(text);
    piece.is_harmless || stays(piece.bytes) ? result += piece.bytes : result += escaped(piece);
    text.remove_prefix(piece.bytes.size());
  }
  return result;
}

}  // namespace

TextPiece first_piece(std::string_view text) {
  const Utf8Character character = first_utf8_character(text);
  if (character.length == 0) {
    return {text.substr(0, 1)};
  }
  return {text.substr(0, character.length), true, character.code, !is_harmful(character.code)};
}

std::string printable(std::string_view text) {
  return with_escapes(text, [](std::string_view /*piece*/) { return false; });
}

std::string printable_lines(std::string_view text) {
  return with_escapes(text, [](std::string_view piece) { return piece == "\n"; });
}

}  // namespace trismooth

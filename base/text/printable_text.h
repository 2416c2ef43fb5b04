// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trismooth {

/// A piece of text that came from outside (names, paths, arguments), judged by what it does where it is shown.
struct TextPiece {
  std::string_view bytes;     ///< a character in UTF-8, or one byte that belongs to none
  bool is_character = false;  ///< in UTF-8
  char32_t code = 0;          ///< of the character
  /// It shows as itself and changes nothing else: no control character (U+0000 to U+001F, U+007F to U+009F), no
  /// direction of writing forced upon its neighbours (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069), no
  /// line or paragraph separator (U+2028, U+2029), no mark of byte order (U+FEFF), no byte that is no UTF-8.
  bool is_harmless = false;
};

/// The first piece of `text`, which is not empty.
TextPiece first_piece(std::string_view text);

/// The text for a terminal: what is not harmless stands as \x1b (bytes and codes below 80 hexadecimal) or \u202e. Line
/// feeds as well, so it is one line. A backslash stays as it is: escaping twice is the same as once.
std::string printable(std::string_view text);

/// printable() of a text of several lines: line feeds stay.
std::string printable_lines(std::string_view text);

}  // namespace trismooth

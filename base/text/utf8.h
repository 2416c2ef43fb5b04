// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace trismooth {

/// A character of a text in UTF-8.
struct Utf8Character {
  std::size_t length = 0;  ///< bytes that it takes; 0: there is none
  char32_t code = 0;
};

/// The character at the start of `text`; none where it is empty, or does not begin with a whole, shortest form of a
/// character from U+0000 to U+10FFFF that is no surrogate (RFC 3629). Constant time.
Utf8Character first_utf8_character(std::string_view text);

/// Whether bytes that follow could make `text`, which is not empty, begin with a character.
bool is_begun_utf8_character(std::string_view text);

}  // namespace trismooth

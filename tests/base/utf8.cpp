// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/utf8.h"

#include <string>
#include <string_view>

#include "catch.h"

using trismooth::first_utf8_character;
using trismooth::is_begun_utf8_character;

namespace {

/// RFC 3629, section 3, from the code to the bytes: the way back from what is tested.
std::string encoded(char32_t code) {
  const auto tail = [code](unsigned shift) { return static_cast<char>(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) {
    return {static_cast<char>(code)};
  }
  if (code < 0x800) {
    return {static_cast<char>(0xC0U | (code >> 6)), tail(0)};
  }
  if (code < 0x10000) {
    return {static_cast<char>(0xE0U | (code >> 12)), tail(6), tail(0)};
  }
  return {static_cast<char>(0xF0U | (code >> 18)), tail(12), tail(6), tail(0)};
}

}  // namespace

TEST_CASE("every character is decoded from its bytes, alone, before others, and not from fewer bytes") {
  for (char32_t code = 0; code <= 0x10FFFF; code += code < 0x11000 ? 1 : 97) {
    if (code >= 0xD800 && code < 0xE000) {
      continue;
    }
    const std::string bytes = encoded(code);
    const auto alone = first_utf8_character(bytes);
    const auto before_others = first_utf8_character(bytes + "\x80x");
    const bool right = alone.length == bytes.size() && alone.code == code && before_others.length == bytes.size() &&
                       before_others.code == code;
    bool cut_is_none = true;
    for (std::size_t size = 1; size < bytes.size(); ++size) {
      const std::string_view cut = std::string_view(bytes).substr(0, size);
      cut_is_none = cut_is_none && first_utf8_character(cut).length == 0 && is_begun_utf8_character(cut);
    }
    if (!right || !cut_is_none || is_begun_utf8_character(bytes)) {
      CAPTURE(static_cast<unsigned long>(code));
      FAIL();
    }
  }
}

TEST_CASE("what is no character: nothing, stray bytes, longer forms, surrogates, codes beyond the last") {
  using namespace std::string_view_literals;
  for (const std::string_view bytes :
       {""sv, "\x80"sv, "\xbf"sv, "\xc0\x80"sv, "\xc1\xbf"sv, "\xe0\x80\x80"sv, "\xe0\x9f\xbf"sv, "\xf0\x80\x80\x80"sv,
        "\xf0\x8f\xbf\xbf"sv, "\xed\xa0\x80"sv, "\xed\xbf\xbf"sv, "\xf4\x90\x80\x80"sv, "\xf5\x80\x80\x80"sv, "\xff"sv,
        "\xc3x"sv, "\xe2\x80x"sv, "\xf0\x9f\x98x"sv}) {
    CAPTURE(std::string(bytes));
    CHECK(first_utf8_character(bytes).length == 0);
  }
  CHECK_FALSE(is_begun_utf8_character("\xe2x"));
  CHECK_FALSE(is_begun_utf8_character("\x80"));
  CHECK_FALSE(is_begun_utf8_character("\xff"));
}

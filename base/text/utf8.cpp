// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/utf8.h"

#include <algorithm>

namespace trismooth {

namespace {

/// How long the sequence is that such a byte begins; 0: it begins none.
std::size_t length_after(unsigned char lead) {
  return lead < 0x80                   ? 1
         : lead >= 0xC2 && lead < 0xE0 ? 2
         : lead >= 0xE0 && lead < 0xF0 ? 3
         : lead >= 0xF0 && lead < 0xF5 ? 4
                                       : 0;
}

bool is_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

Utf8Character first_utf8_character(std::string_view text) {
  if (text.empty()) {
    return {};
  }
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = length_after(lead);
  if (length == 0 || length > text.size() || !std::ranges::all_of(text.substr(1, length - 1), &is_continuation)) {
    return {};
  }
  char32_t code = length == 1 ? lead : lead & (0x7FU >> length);
  for (const char byte : text.substr(1, length - 1)) {
    code = (code << 6) | (static_cast<unsigned char>(byte) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool no_character = (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF;
  return overlong || no_character ? Utf8Character{} : Utf8Character{length, code};
}

bool is_begun_utf8_character(std::string_view text) {
  return text.size() < length_after(static_cast<unsigned char>(text[0])) &&
         std::ranges::all_of(text.substr(1), &is_continuation);
}

}  // namespace trismooth

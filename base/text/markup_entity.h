// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// What stands for a character that is markup in HTML and in XML, in text and between double quotes; empty for all
/// others.
constexpr std::string_view markup_entity(char character) {
  switch (character) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

}  // namespace trismooth

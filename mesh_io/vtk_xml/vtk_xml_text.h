// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

/// Cuts the next token off the text of an element; empty at its end.
inline std::string_view take_xml_token(std::string_view& text) {
  const auto separates = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  std::size_t begin = 0;
  while (begin < text.size() && separates(text[begin])) {
    ++begin;
  }
  std::size_t end = begin;
  while (end < text.size() && !separates(text[end])) {
    ++end;
  }
  const std::string_view token = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return token;
}

/// The number that the token states; nothing where it is none of the type, or beyond its range.
template <class T>
std::optional<T> parse_xml_number(std::string_view token) {
  if constexpr (std::is_floating_point_v<T>) {
    const std::optional<T> value = parse_number<T>(token);
    const bool beyond_range =
        value && std::isinf(*value) && token.find_first_of("0123456789") != std::string_view::npos;
    return beyond_range ? std::nullopt : value;
  } else {
    return parse_integer_as<T>(token);
  }
}

/// The whole number that an attribute states, with or without white space around it (writers in Fortran pad numbers);
/// nothing where it is none.
inline std::optional<std::uint64_t> parse_xml_count(std::string_view text) {
  const std::string_view token = take_xml_token(text);
  return take_xml_token(text).empty() ? parse_xml_number<std::uint64_t>(token) : std::nullopt;
}

}  // namespace trismooth

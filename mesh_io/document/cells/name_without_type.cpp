// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/name_without_type.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

constexpr auto words = std::to_array<std::string_view>(
    {"tri", "tris", "tria", "trias", "triangle", "triangles", "quad", "quads", "quadrangle", "quadrangles",
     "quadrilateral", "quadrilaterals", "polygon", "polygons", "ngon", "ngons", "nsided", "mixed"});

constexpr bool is_letter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

constexpr bool is_small(char c) {
  return 'a' <= c && c <= 'z';
}

constexpr std::string_view separators = " _-.:/";

bool is_word(std::string_view text) {
  return std::ranges::find(words, lower_case(text)) != words.end();
}

/// Behind the number of nodes that may stand behind a type: "4" or "_4".
std::size_t behind_nodes(std::string_view name, std::size_t at) {
  constexpr std::string_view numbers = "34689";
  const std::size_t place = at < name.size() && name[at] == '_' ? at + 1 : at;
  const bool has_number = place < name.size() && numbers.find(name[place]) != std::string_view::npos;
  const bool goes_on = place + 1 < name.size() && '0' <= name[place + 1] && name[place + 1] <= '9';
  return has_number && !goes_on ? place + 1 : at;
}

}  // namespace

std::string name_without_type(std::string_view name) {
  std::string rest;
  for (std::size_t at = 0; at < name.size();) {
    std::size_t end = at + 1;
    // A word begins with a capital letter or behind what is no letter.
    while (end < name.size() && is_letter(name[at]) && is_letter(name[end]) &&
           (is_small(name[end]) || !is_small(name[end - 1]))) {
      ++end;
    }
    const bool is_type = is_word(name.substr(at, end - at));
    if (!is_type) {
      rest.append(name.substr(at, end - at));
    }
    at = is_type ? behind_nodes(name, end) : end;
  }
  const std::size_t first = rest.find_first_not_of(separators);
  return first == std::string::npos ? std::string() : rest.substr(first, rest.find_last_not_of(separators) + 1 - first);
}

}  // namespace trismooth

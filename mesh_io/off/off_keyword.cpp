// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_keyword.h"

#include <algorithm>

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

constexpr std::size_t longest_keyword = 9;  // STCN4nOFF

}  // namespace

std::size_t OffKeyword::least_extras() const {
  return (normals ? 3U : 0U) + (texture_coordinates ? 2U : 0U);
}

bool OffKeyword::allows_extras(std::size_t count) const {
  const std::size_t least = least_extras();
  return count == least || count == least + 3 || count == least + 4;
}

std::string OffKeyword::describe_extras() const {
  const std::size_t least = least_extras();
  return std::to_string(least) + ", " + std::to_string(least + 3) + " or " + std::to_string(least + 4) + " numbers";
}

std::string OffKeyword::text_or_default() const {
  return text.empty() ? "OFF" : std::string(text);
}

OffExtras OffKeyword::split(std::span<const double> row) const {
  const std::size_t normal_count = normals ? 3 : 0;
  const std::size_t texture_count = texture_coordinates ? 2 : 0;
  const std::size_t colour_count = row.size() - normal_count - texture_count;
  const std::size_t normal_begin = colours_first ? colour_count : 0;
  const std::size_t colour_begin = colours_first ? 0 : normal_count;
  return {row.subspan(normal_begin, normal_count), row.subspan(colour_begin, colour_count), row.last(texture_count)};
}

std::optional<OffKeyword> parse_off_keyword(std::string_view token) {
  const std::string capitals = upper_case(token.substr(0, longest_keyword));
  const std::size_t off = capitals.find("OFF");
  if (off == std::string_view::npos) {
    return std::nullopt;
  }
  const std::size_t end = off + 3;
  if (token.find_first_not_of("0123456789", end) != std::string_view::npos) {
    return std::nullopt;
  }
  OffKeyword keyword;
  keyword.text = token.substr(0, end);
  const std::string_view prefix =
      token.substr(off, 3) == "OFF" ? token.substr(0, off) : std::string_view(capitals).substr(0, off);
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (prefix.substr(i, 2) == "ST") {
      keyword.texture_coordinates = true;
      ++i;
    } else if (prefix[i] == 'C') {
      keyword.colours_first = keyword.normals;
      keyword.colours = true;
    } else if (prefix[i] == 'N') {
      keyword.normals = true;
    } else if (prefix[i] == '4') {
      keyword.homogeneous = true;
    } else if (prefix[i] == 'n') {
      keyword.any_dimension = true;
    } else {
      return std::nullopt;
    }
  }
  return keyword;
}

}  // namespace trismooth

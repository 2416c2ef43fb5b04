// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/adcirc/adcirc_boundary.h"

#include <algorithm>
#include <array>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::string_view open_title = "open boundary ";
constexpr std::string_view land_title = "land boundary ";
constexpr std::string_view weir_title = "weir ";
constexpr std::string_view type_begin = " (type ";

template <std::size_t count>
bool is_one_of(const std::array<std::int64_t, count>& types, std::int64_t type) {
  return std::ranges::find(types, type) != types.end();
}

}  // namespace

bool is_adcirc_weir(std::int64_t type) {
  return is_one_of(std::to_array<std::int64_t>({3, 13, 23, 4, 24, 64, 5, 25}), type);
}

bool has_adcirc_pairs(std::int64_t type) {
  return is_one_of(std::to_array<std::int64_t>({4, 24, 64, 5, 25, 94}), type);
}

std::string name_of(const AdcircBoundary& boundary) {
  std::string name(boundary.is_open ? open_title : is_adcirc_weir(boundary.type) ? weir_title : land_title);
  name += std::to_string(boundary.number);
  // Nearly all open boundaries are of type 0.
  if (!boundary.is_open || boundary.type != 0) {
    name.append(type_begin).append(std::to_string(boundary.type)).append(")");
  }
  return name;
}

std::optional<AdcircBoundary> parse_adcirc_boundary(std::string_view name) {
  const std::size_t begin = name.find_first_of("0123456789");
  if (begin == std::string_view::npos) {
    return std::nullopt;
  }
  AdcircBoundary boundary{.is_open = name.starts_with(open_title)};
  const std::size_t end = std::min(name.find(type_begin, begin), name.size());
  if (end < name.size()) {
    const std::size_t type = end + type_begin.size();
    boundary.type = parse_integer(name.substr(type, name.size() - 1 - type)).value_or(0);
  }
  boundary.number = parse_integer_as<std::uint64_t>(name.substr(begin, end - begin)).value_or(0);
  return name_of(boundary) == name ? std::optional(boundary) : std::nullopt;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace trismooth {

/// Characters of the name of a variable, and of its unit behind it.
inline constexpr std::size_t selafin_name_size = 16;
inline constexpr std::size_t selafin_unit_size = 16;

/// The variable that has the elevation of the bottom.
inline constexpr std::string_view selafin_bottom = "BOTTOM";

/// Whether a variable says something of the place, whatever runs over it: in TELEMAC's English and French.
inline bool is_selafin_place_value(std::string_view name) {
  for (const std::string_view known : {selafin_bottom, std::string_view("FOND"), std::string_view("BOTTOM FRICTION"),
                                       std::string_view("FROTTEMENT")}) {
    if (name == known) {
      return true;
    }
  }
  return false;
}

}  // namespace trismooth

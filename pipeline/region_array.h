// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// Why a cell array counts as one that gives regions.
enum class RegionReason : std::uint8_t {
  named,              ///< the user named it
  known_name,         ///< programs write regions under this name
  looks_like_regions  ///< whole numbers, few of them, that change across few edges
};

template <>
struct EnumText<RegionReason> {
  static constexpr std::string_view what = "reason";
  static constexpr std::array<std::pair<RegionReason, std::string_view>, 3> texts{
      {{RegionReason::named, "named"},
       {RegionReason::known_name, "known_name"},
       {RegionReason::looks_like_regions, "looks_like_regions"}}};
};

/// A cell array that was obeyed: vertices between two of its values are held.
struct RegionArray {
  std::string name;
  RegionReason reason = RegionReason::named;
  std::int32_t values = 0;         ///< different values that triangles have
  std::int64_t held_vertices = 0;  ///< vertices where triangles of different values meet
};

}  // namespace trismooth

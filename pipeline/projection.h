// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// Where a mesh is smoothed that does not lie in a plane: what the third coordinate is a function of.
enum class Projection : std::uint8_t {
  xy,  ///< a surface z(x, y): smoothed in x and y, z is a value at the vertices
};

template <>
struct EnumText<Projection> {
  static constexpr std::string_view what = "projection";
  static constexpr std::array<std::pair<Projection, std::string_view>, 1> texts{{{Projection::xy, "xy"}}};
};

}  // namespace trismooth

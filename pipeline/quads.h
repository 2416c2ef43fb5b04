// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// What becomes of quadrilaterals of four nodes.
enum class Quads : std::uint8_t {
  smooth,  ///< they are elements as triangles are
  hold,    ///< they are kept as they are, their vertices held fixed
};

template <>
struct EnumText<Quads> {
  static constexpr std::string_view what = "setting of quadrilaterals";
  static constexpr std::array<std::pair<Quads, std::string_view>, 2> texts{
      {{Quads::smooth, "smooth"}, {Quads::hold, "hold"}}};
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// What becomes of the values of point arrays where vertices move.
enum class Fields : std::uint8_t {
  keep,         ///< every vertex keeps its values
  interpolate,  ///< a vertex that moved gets those that the mesh as it was read has at its new place
};

template <>
struct EnumText<Fields> {
  static constexpr std::string_view what = "choice of fields";
  static constexpr std::array<std::pair<Fields, std::string_view>, 2> texts{
      {{Fields::keep, "keep"}, {Fields::interpolate, "interpolate"}}};
};

/// A point array whose values followed the mesh.
struct InterpolatedField {
  std::string name;  ///< in the file
  std::int64_t interpolated_vertices = 0;

  bool operator==(const InterpolatedField&) const = default;
};

}  // namespace trismooth

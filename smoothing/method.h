// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// Where a vertex is moved to, and whether. What computes it is in smoothing/methods, a header for each.
enum class Method : std::uint8_t {
  smart,       ///< to the mean of its neighbours, if the worst of its elements gets better (the paper)
  laplacian,   ///< to the mean of its neighbours
  weighted,    ///< towards the mean of its neighbours weighted by edge length, as smart does
  mean_ratio,  ///< where an energy of its elements' shapes and sizes gets smaller, by Newton's method
};

template <>
struct EnumText<Method> {
  static constexpr std::string_view what = "method";
  static constexpr auto texts = std::to_array<std::pair<Method, std::string_view>>({
      {Method::smart, "smart"},
      {Method::laplacian, "laplacian"},
      {Method::weighted, "weighted"},
      {Method::mean_ratio, "mean-ratio"},
  });
  static constexpr std::array<std::string_view, texts.size()> meanings{
      "to the mean of the neighbours, where the worst element around gets better",
      "always",
      "towards the mean by edge length, as smart",
      "where an energy of all elements around is smaller, for the best elements",
  };
};

}  // namespace trismooth

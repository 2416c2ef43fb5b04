// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// The elements as triangles, where all of them are; else nothing. Complexity: linear.
inline std::optional<std::vector<Triangle>> triangles_alone(std::span<const MixedElement> elements) {
  if (!std::ranges::all_of(elements, [](const MixedElement& element) { return element[3] == no_corner; })) {
    return std::nullopt;
  }
  std::vector<Triangle> triangles(elements.size());
  std::ranges::transform(elements, triangles.begin(), [](const MixedElement& e) { return Triangle{e[0], e[1], e[2]}; });
  return triangles;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/slide_triangles.h"

#include <algorithm>
#include <cstddef>

namespace trismooth {

SlideTriangles::SlideTriangles(const Slidable& slidable, std::span<const std::uint8_t> reversed) {
  const auto is_reversed = [&](std::int32_t t) { return reversed[static_cast<std::size_t>(t)] != 0; };
  begins.reserve(slidable.vertices.size() + 1);
  sides.reserve(slidable.fans.side_count());
  for (std::int32_t v = 0; v < slidable.vertex_count(); ++v) {
    for (const ListedSide& side : slidable.fans.around(v)) {
      sides.push_back(is_reversed(side.triangle)
                          ? FanSide{side.second, side.first, side.second_is_unknown, side.first_is_unknown}
                          : FanSide{side.first, side.second, side.first_is_unknown, side.second_is_unknown});
    }
    begins.push_back(static_cast<std::int32_t>(sides.size()));
  }
  for (const std::int32_t t : slidable.fans.held_triangles()) {
    held.push_back(canonical_corners(slidable.triangles[static_cast<std::size_t>(t)], is_reversed(t)));
  }
}

SlideTriangles SlideTriangles::renumbered(std::span<const std::int32_t> numbers) const {
  SlideTriangles found = *this;
  const auto give = [&](std::int32_t& v) { v = numbers[static_cast<std::size_t>(v)]; };
  for (FanSide& side : found.sides) {
    give(side.from);
    give(side.to);
  }
  for (Triangle& triangle : found.held) {
    std::ranges::for_each(triangle, give);
  }
  return found;
}

}  // namespace trismooth

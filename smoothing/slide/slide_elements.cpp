// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/slide_elements.h"

#include <algorithm>
#include <cstddef>

namespace trismooth {

SlideElements::SlideElements(const Slidable& slidable, std::span<const std::uint8_t> reversed) {
  const auto is_reversed = [&](std::int32_t e) { return reversed[static_cast<std::size_t>(e)] != 0; };
  const auto node = [&](std::int32_t v) { return FanNode{v, v != no_corner && slidable.fans.is_unknown(v)}; };
  begins.reserve(slidable.vertices.size() + 1);
  sides.reserve(slidable.fans.side_count());
  for (std::int32_t v = 0; v < slidable.vertex_count(); ++v) {
    for (const ListedSide& side : slidable.fans.around(v)) {
      const bool turns = is_reversed(side.element);
      sides.push_back(
          {node(turns ? side.second : side.first), node(side.opposite), node(turns ? side.first : side.second)});
    }
    begins.push_back(static_cast<std::int32_t>(sides.size()));
  }
  for (const std::int32_t e : slidable.fans.held_elements()) {
    held.push_back(canonical_corners(slidable.elements[static_cast<std::size_t>(e)], is_reversed(e)));
  }
}

SlideElements SlideElements::renumbered(std::span<const std::int32_t> numbers) const {
  SlideElements found = *this;
  const auto give = [&](std::int32_t& v) { v = v == no_corner ? v : numbers[static_cast<std::size_t>(v)]; };
  for (FanSide& side : found.sides) {
    for (FanNode* const node : {&side.from, &side.opposite, &side.to}) {
      give(node->vertex);
    }
  }
  for (MixedElement& element : found.held) {
    std::ranges::for_each(element, give);
  }
  return found;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/slidable.h"
#include "trismooth/smoothing/slide/slide_view.h"

namespace trismooth {

/// The elements that sliding vertices are corners of, wherever they are: all of this is known before anybody slides.
struct SlideElements {
  std::vector<std::int32_t> begins{
      0};  ///< sides[begins[v]] .. sides[begins[v + 1]] are around vertex v of the Slidable
  std::vector<FanSide> sides;
  /// Those with a vertex that may slide, as far as connectivity says it, and none that is free: no one-ring has them.
  /// Canonical corners.
  std::vector<MixedElement> held;

  /// None.
  SlideElements() = default;
  /// Vertices have the numbers of `slidable`. `reversed`: as MeshRings::reversed, of its elements. Complexity: linear.
  SlideElements(const Slidable& slidable, std::span<const std::uint8_t> reversed);

  /// These elements, where vertex v, as a corner, has the number numbers[v].
  SlideElements renumbered(std::span<const std::int32_t> numbers) const;

  std::span<const FanSide> around(std::int32_t v) const {
    const auto i = static_cast<std::size_t>(v);
    return std::span(sides).subspan(static_cast<std::size_t>(begins[i]),
                                    static_cast<std::size_t>(begins[i + 1] - begins[i]));
  }
};

}  // namespace trismooth

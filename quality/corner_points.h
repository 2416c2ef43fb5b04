// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/machine/prefetch.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"

namespace trismooth {

/// The corners of an element of the view, in canonical order.
template <class Corners>
inline auto corner_points(const ElementView<Corners>& view, std::size_t element) {
  return points_of(canonical_corners(view, element), view.points);
}

/// What body(corners) returns of the points of an element's corners, in canonical order: those of its kind, of an array
/// of Triangle, or of MixedElement with triangles among them.
template <class Corners, class Body>
inline auto with_points(const ElementView<Corners>& view, std::size_t element, const Body& body) {
  return with_kind(canonical_corners(view, element),
                   [&](const auto& corners) { return body(points_of(corners, view.points)); });
}

/// Calls body(first, corners) for elements [begin, end) of the view in order, some hundred at a time: `corners` are
/// those of element `first` and its successors. They are gathered before anything is computed, and asked for earlier
/// still, since only that overlaps the cache misses of a mesh in random order. (No more at a time: the stack of a
/// program that has no memory left does not grow.)
template <class Corners, class Body>
void for_corners(const ElementView<Corners>& view, std::size_t begin, std::size_t end, const Body& body) {
  using Points = decltype(corner_points(view, begin));
  constexpr std::size_t at_once = 256;
  constexpr std::size_t ahead = 48;
  std::array<Points, at_once> corners;
  for (std::size_t first = begin; first < end; first += at_once) {
    const std::size_t count = std::min(at_once, end - first);
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::int32_t v : view.elements[std::min(first + i + ahead, view.elements.size() - 1)]) {
        prefetch(&view.points[static_cast<std::size_t>(v)]);
      }
      corners[i] = corner_points(view, first + i);
    }
    body(first, std::span<const Points>(corners).first(count));
  }
}

}  // namespace trismooth

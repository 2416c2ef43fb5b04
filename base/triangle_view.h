// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"

namespace trismooth {

/// Indices of a triangle's three corners.
using Triangle = std::array<std::int32_t, 3>;

/// Indices of the corners of a triangle or a quadrilateral, in turn, for meshes that have both: the last one of a
/// triangle is no_corner.
using MixedElement = std::array<std::int32_t, 4>;
inline constexpr std::int32_t no_corner = -1;

/// The nodes of an element, and no_corner behind them: three or six of a triangle, four, eight or nine of a
/// quadrilateral; corners in turn, then the middles of the sides 01, 12, ..., then the centre.
using ElementNodes = std::array<std::int32_t, 9>;

/// How many nodes stand before the first no_corner.
constexpr std::size_t node_count(const ElementNodes& nodes) {
  std::size_t count = 0;
  while (count < nodes.size() && nodes[count] != no_corner) {
    ++count;
  }
  return count;
}

/// How many corners an element of so many nodes has: 3 or 4. 0: there is no such element.
constexpr std::size_t corners_of_nodes(std::size_t nodes) {
  return nodes == 3 || nodes == 6 ? 3 : nodes == 4 || nodes == 8 || nodes == 9 ? 4 : 0;
}

/// A triangle among elements of both kinds.
constexpr MixedElement as_mixed(const Triangle& triangle) {
  return {triangle[0], triangle[1], triangle[2], no_corner};
}
/// An element that is listed so already.
template <std::size_t most>
constexpr MixedElement as_mixed(const std::array<std::int32_t, most>& element) {
  static_assert(most == 4);
  return element;
}

/// How many corners a Triangle or a MixedElement has.
template <std::size_t most>
constexpr int corner_count(const std::array<std::int32_t, most>& element) {
  static_assert(most == 3 || most == 4);
  return element[most - 1] == no_corner ? 3 : static_cast<int>(most);
}

/// The elements of one mesh for evaluation, or those of one kind: triangles, or quadrilaterals. All views; the caller
/// owns.
template <class Corners>
struct ElementView {
  std::span<const Point2<double>> points;  ///< in the local frame
  std::span<const Corners> elements;       ///< corners within points, in the order of the file
  std::span<const std::uint8_t> reversed;  ///< 1 where the element is listed clockwise relative to the positive
                                           ///< orientation of its component; empty: none is
  int exponent = 0;                        ///< of the local frame: lengths in the file are local * 2^exponent
};
using TriangleView = ElementView<Triangle>;
using QuadrilateralView = ElementView<MixedElement>;  ///< no triangles are among them

/// The corners in the order in which an element's quality is evaluated everywhere outside one-rings (report, guard):
/// counter-clockwise in the consistent orientation, the smallest index first. So every evaluation of an element gives
/// the same bits, however the file lists it.
constexpr Triangle canonical_corners(const Triangle& triangle, bool reversed) {
  const std::int32_t a = triangle[0];
  const std::int32_t b = reversed ? triangle[2] : triangle[1];
  const std::int32_t c = reversed ? triangle[1] : triangle[2];
  // (No branches, which would be guessed wrong: & is meant.)
  const bool b_first = (b < a) & (b <= c);
  const bool c_first = (c < a) & (c < b);
  return {c_first ? c : (b_first ? b : a), c_first ? a : (b_first ? c : b), c_first ? b : (b_first ? a : c)};
}

/// Those of a MixedElement.
template <std::size_t most>
constexpr std::array<std::int32_t, most> canonical_corners(const std::array<std::int32_t, most>& element,
                                                           bool reversed) {
  static_assert(most == 4);
  if (element[3] == no_corner) {
    const Triangle corners = canonical_corners(Triangle{element[0], element[1], element[2]}, reversed);
    return as_mixed(corners);
  }
  std::size_t first = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    first = element[i] < element[first] ? i : first;
  }
  const std::size_t step = reversed ? 3 : 1;
  return {element[first], element[(first + step) % 4], element[(first + 2) % 4], element[(first + 3 * step) % 4]};
}

/// The canonical corners of element `index` of the view.
template <class Corners>
constexpr Corners canonical_corners(const ElementView<Corners>& view, std::size_t index) {
  return canonical_corners(view.elements[index], !view.reversed.empty() && view.reversed[index] != 0);
}

}  // namespace trismooth

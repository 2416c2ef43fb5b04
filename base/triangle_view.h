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

/// The triangles of one mesh for evaluation. All views; the caller owns.
struct TriangleView {
  std::span<const Point2<double>> points;  ///< in the local frame
  std::span<const Triangle> triangles;     ///< corners within points, in the order of the file
  std::span<const std::uint8_t> reversed;  ///< 1 where the triangle is listed clockwise relative to the positive
                                           ///< orientation of its component; empty: none is
  int exponent = 0;                        ///< of the local frame: lengths in the file are local * 2^exponent
};

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

/// The canonical corners of triangle `index` of the view.
constexpr Triangle canonical_corners(const TriangleView& view, std::size_t index) {
  return canonical_corners(view.triangles[index], !view.reversed.empty() && view.reversed[index] != 0);
}

}  // namespace trismooth

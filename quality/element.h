// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/quadrilateral_quality.h"
#include "trismooth/quality/triangle_quality.h"

/// What the guard, reports, regions and all others that go over a mesh ask of an element: a function for each kind of
/// element, by its corners or by their points. Corners are in canonical order (see canonical_corners()) wherever bits
/// count.
///
/// A triangle has three corners, a quadrilateral four: MixedElement with no no_corner among them.
namespace trismooth {

/// The corners of a Triangle or of a MixedElement, in turn: three or four. Views the element.
template <std::size_t most>
constexpr std::span<const std::int32_t> corners_of(const std::array<std::int32_t, most>& element) {
  return std::span<const std::int32_t>(element).first(static_cast<std::size_t>(corner_count(element)));
}

/// The corners from the one on of which number(v) is the smallest, in the same sense of rotation: canonical order where
/// the input has other numbers than the corners.
template <class Number>
constexpr Triangle from_smallest(const Triangle& corners, const Number& number) {
  const auto& [a, b, c] = corners;
  const std::int32_t of_a = number(a);
  const std::int32_t of_b = number(b);
  const std::int32_t of_c = number(c);
  // (No branches, which would be guessed wrong: & is meant.)
  const bool b_first = (of_b < of_a) & (of_b <= of_c);
  const bool c_first = (of_c < of_a) & (of_c < of_b);
  return {c_first ? c : (b_first ? b : a), c_first ? a : (b_first ? c : b), c_first ? b : (b_first ? a : c)};
}

template <class Number>
constexpr MixedElement from_smallest(const MixedElement& quadrilateral, const Number& number) {
  std::size_t first = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    first = number(quadrilateral[i]) < number(quadrilateral[first]) ? i : first;
  }
  return {quadrilateral[first], quadrilateral[(first + 1) % 4], quadrilateral[(first + 2) % 4],
          quadrilateral[(first + 3) % 4]};
}

/// The points of an element's corners.
template <class T>
using TrianglePoints = std::array<Point2<T>, 3>;
using CornerPoints = TrianglePoints<double>;

template <class T>
using FourPoints = std::array<Point2<T>, 4>;
using QuadrilateralPoints = FourPoints<double>;

/// The points of these corners, where position(v) is vertex v.
template <class Position>
constexpr TRISMOOTH_HOST_DEVICE auto points_of(const Triangle& corners, const Position& position) {
  return TrianglePoints<decltype(position(0).x)>{position(corners[0]), position(corners[1]), position(corners[2])};
}
template <class Position>
constexpr TRISMOOTH_HOST_DEVICE auto points_of(const MixedElement& corners, const Position& position) {
  return FourPoints<decltype(position(0).x)>{position(corners[0]), position(corners[1]), position(corners[2]),
                                             position(corners[3])};
}
/// The points of these corners, where points[v] is vertex v.
template <class Points>
requires requires(const Points& points) {
  points[0];
}
constexpr TRISMOOTH_HOST_DEVICE auto points_of(const Triangle& corners, const Points& points) {
  return points_of(corners, [&](std::int32_t v) { return points[v]; });
}
template <class Points>
requires requires(const Points& points) {
  points[0];
}
constexpr TRISMOOTH_HOST_DEVICE auto points_of(const MixedElement& corners, const Points& points) {
  return points_of(corners, [&](std::int32_t v) { return points[v]; });
}

/// Calls body with the element, a Triangle where it is one.
template <class Body>
constexpr TRISMOOTH_HOST_DEVICE auto with_kind(const Triangle& triangle, const Body& body) {
  return body(triangle);
}
template <class Body>
constexpr TRISMOOTH_HOST_DEVICE auto with_kind(const MixedElement& element, const Body& body) {
  return element[3] == no_corner ? body(Triangle{element[0], element[1], element[2]}) : body(element);
}

/// The shape without its factor (see triangle_quality.h).
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(const TrianglePoints<T>& corners) {
  return shape_quotient(corners[0], corners[1], corners[2]);
}
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape(const TrianglePoints<T>& corners) {
  return shape(corners[0], corners[1], corners[2]);
}
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T shape_quotient(const FourPoints<T>& corners) {
  return shape_quotient(corners[0], corners[1], corners[2], corners[3]);
}
constexpr double shape(const QuadrilateralPoints& corners) {
  return shape(corners[0], corners[1], corners[2], corners[3]);
}

/// The shape quotient of an element of either kind, where points[v], or points(v), is vertex v.
template <class Corners, class Points>
constexpr TRISMOOTH_HOST_DEVICE auto quotient_at(const Corners& corners, const Points& points) {
  return with_kind(corners, [&](const auto& element) { return shape_quotient(points_of(element, points)); });
}

/// Twice the area, positive where the element is counter-clockwise.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T doubled_area(const TrianglePoints<T>& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[0]);
}
constexpr double doubled_area(const QuadrilateralPoints& corners) {
  return cross(corners[2] - corners[0], corners[3] - corners[1]);
}

/// The middle of the corners.
constexpr Point2<double> centroid(const CornerPoints& corners) {
  const auto& [a, b, c] = corners;
  return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
}
constexpr Point2<double> centroid(const QuadrilateralPoints& corners) {
  const auto& [a, b, c, d] = corners;
  return {((a.x + b.x) + (c.x + d.x)) / 4, ((a.y + b.y) + (c.y + d.y)) / 4};
}

/// Whether all corners are held: fixed[v] is not 0.
template <class Element, class Fixed>
constexpr TRISMOOTH_HOST_DEVICE bool all_are_fixed(const Element& corners, const Fixed& fixed) {
  for (const std::int32_t v : corners) {
    if (fixed[v] == 0) {
      return false;
    }
  }
  return true;
}
template <class Fixed>
constexpr bool all_are_fixed(const MixedElement& corners, const Fixed& fixed) {
  return std::ranges::all_of(corners, [&](std::int32_t v) { return v == no_corner || fixed[v] != 0; });
}

}  // namespace trismooth

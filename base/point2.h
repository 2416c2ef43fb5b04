// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"

namespace trismooth {

/// A point or a vector of the plane. T is float or double.
template <class T>
struct Point2 {
  T x;
  T y;

  /// By value: -0 equals 0, NaN equals nothing.
  friend constexpr TRISMOOTH_HOST_DEVICE bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }
  /// The vector from b to a.
  friend constexpr TRISMOOTH_HOST_DEVICE Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
};

/// `now`, of which a coordinate that equals that of `before` has its bits: -0 stays -0.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE Point2<T> with_kept_bits(Point2<T> before, Point2<T> now) {
  return {now.x == before.x ? before.x : now.x, now.y == before.y ? before.y : now.y};
}

/// Bit for bit: zeros of different signs differ.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE bool have_same_bits(Point2<T> a, Point2<T> b) {
  using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
  return std::bit_cast<Bits>(a.x) == std::bit_cast<Bits>(b.x) && std::bit_cast<Bits>(a.y) == std::bit_cast<Bits>(b.y);
}

/// Twice the signed area between two vectors: positive where b is counter-clockwise of a.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T cross(Point2<T> a, Point2<T> b) {
  return a.x * b.y - a.y * b.x;
}

/// The square of a vector's length.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T squared_length(Point2<T> a) {
  return a.x * a.x + a.y * a.y;
}

}  // namespace trismooth

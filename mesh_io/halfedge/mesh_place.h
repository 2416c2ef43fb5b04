// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/space/plane.h"

namespace trismooth {

class Workers;

/// Where number `k` of point `v` is.
template <class T>
T& number_at(const NumberRows<T>& points, std::size_t v, std::size_t k) {
  const auto offset =
      static_cast<std::ptrdiff_t>(v) * points.row_stride + static_cast<std::ptrdiff_t>(k) * points.column_stride;
  using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
  return *reinterpret_cast<T*>(reinterpret_cast<Byte*>(points.first) + offset);
}

/// For reading alone.
template <class T>
NumberRows<const T> constant(const NumberRows<T>& points) {
  return {points.first, points.rows, points.columns, points.row_stride, points.column_stride};
}

/// The type of the numbers.
template <class T>
inline constexpr Storage storage_of = sizeof(T) == sizeof(float) ? Storage::float32 : Storage::float64;

/// Throws MeshError for the first point with a number that is not finite, of those whose flag in `counts` is not 0.
/// Whether all others are finite, too. Complexity: linear.
template <class T>
bool require_finite(const NumberRows<T>& points, std::span<const std::uint8_t> counts);

/// The two numbers of a point that are coordinates in its plane, where the points whose flag in `counts` is not 0 have
/// but two, or lie along two coordinate axes exactly; else nothing. As fit_plane() finds them. Complexity: linear.
template <class T>
std::optional<std::array<int, 2>> exact_axes(const NumberRows<T>& points, std::span<const std::uint8_t> counts);

/// These two numbers of every point, where they are.
template <class T>
NumberRows<T> along(const NumberRows<T>& points, std::array<int, 2> axes) {
  NumberRows<T> pairs = points;
  pairs.columns = 2;
  if (points.rows > 0) {
    pairs.first = &number_at(points, 0, static_cast<std::size_t>(axes[0]));
    pairs.column_stride *= axes[1] - axes[0];
  }
  return pairs;
}

/// A copy of points of two numbers; those whose flag in `counts` is 0 are at (0, 0). Complexity: linear.
template <class T>
std::vector<Point2<double>> pairs_of(const NumberRows<T>& points, std::span<const std::uint8_t> counts);

/// A copy of points of three numbers. Complexity: linear.
template <class T>
std::vector<double> triples_of(const NumberRows<T>& points);

/// A mesh laid into a plane.
struct InPlane {
  Plane plane;
  BulkVector<Point2<double>> points;
  LocalPoints local;

  /// Throws MeshError where `fit` says that there is no such plane and where no double places a point in it.
  InPlane(const PlaneFit& fit, std::span<const double> xyz, std::span<const std::uint8_t> counts, Workers& workers);
};

}  // namespace trismooth

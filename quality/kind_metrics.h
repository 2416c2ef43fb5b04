// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "trismooth/quality/element.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

/// The metrics that a kind of element has, in the order of all_metrics(), by the points of such elements.
template <class Points>
struct KindMetrics;

template <>
struct KindMetrics<CornerPoints> {
  static constexpr ElementKind kind = ElementKind::triangle;
  static constexpr std::array list{
      Metric::shape,        Metric::area,       Metric::min_angle, Metric::max_angle,       Metric::aspect_ratio,
      Metric::radius_ratio, Metric::edge_ratio, Metric::condition, Metric::scaled_jacobian, Metric::equiangle_skew};
};

template <>
struct KindMetrics<QuadrilateralPoints> {
  static constexpr ElementKind kind = ElementKind::quadrilateral;
  static constexpr std::array list{
      Metric::shape,          Metric::area,       Metric::min_angle, Metric::max_angle,
      Metric::aspect_ratio,   Metric::edge_ratio, Metric::condition, Metric::scaled_jacobian,
      Metric::equiangle_skew, Metric::skew,       Metric::taper};
};

/// How many these are.
template <class Points>
inline constexpr std::size_t count_of_metrics = KindMetrics<Points>::list.size();

/// A value of each.
template <class Points>
using KindValues = std::array<double, count_of_metrics<Points>>;

/// Which of them is the shape, and the area.
inline constexpr std::size_t shape_place = 0;
inline constexpr std::size_t area_place = 1;

}  // namespace trismooth

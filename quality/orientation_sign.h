// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/host_device.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"

namespace trismooth {

/// What has the sign by which an element says how it is listed: the quality of a triangle, the area of a
/// quadrilateral. By its points.
constexpr TRISMOOTH_HOST_DEVICE double orientation_sign(const CornerPoints& corners) {
  return shape_quotient(corners);
}
constexpr TRISMOOTH_HOST_DEVICE double orientation_sign(const QuadrilateralPoints& corners) {
  return doubled_area(corners);
}

/// By its canonical corners, of a Triangle or a MixedElement, where points[v] is vertex v.
template <class Corners, class Points>
constexpr TRISMOOTH_HOST_DEVICE double orientation_sign(const Corners& corners, const Points& points) {
  return with_kind(corners, [&](const auto& element) { return orientation_sign(points_of(element, points)); });
}

}  // namespace trismooth

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// The orientation of every triangle.
struct Orientation {
  std::vector<std::uint8_t> reversed;     ///< 1 where the triangle is listed clockwise in the consistent orientation
  std::int64_t reoriented_triangles = 0;  ///< listed against the majority of their component
};

/// Each component is oriented so that the majority of its triangles is positive; a tie makes its lowest-numbered
/// non-degenerate triangle positive. `points` are in the local frame, so that no product overflows. Complexity: linear.
Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points, Workers& workers);

/// The same on the calling thread.
Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points);

}  // namespace trismooth

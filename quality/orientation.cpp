#include "trismooth/quality/orientation.h"

#include <algorithm>

#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

Orientation orient(const TriangleComponents& components, std::span<const Triangle> triangles,
                   std::span<const Point2<double>> points) {
  struct Count {
    std::int64_t positive = 0;
    std::int64_t negative = 0;
    std::int8_t first = 0;  ///< sign of the lowest-numbered triangle that has one
    std::int64_t triangles = 0;
    std::int64_t against = 0;
  };
  std::vector<Count> counts(static_cast<std::size_t>(components.components));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Count& count = counts[components.component[t]];
    // Where a triangle is nearly degenerate, rounding gives it a sign that differs with the corner that comes first:
    // the sign that counts is that of its quality in every report and in the guard.
    const auto [a, b, c] = canonical_corners(triangles[t], components.parity[t] != 0);
    const double quotient = shape_quotient(points[a], points[b], points[c]);
    count.positive += quotient > 0 ? 1 : 0;
    count.negative += quotient < 0 ? 1 : 0;
    if (count.first == 0 && quotient != 0) {
      count.first = quotient > 0 ? 1 : -1;
    }
    ++count.triangles;
    count.against += components.parity[t];
  }
  Orientation orientation;
  orientation.reversed.resize(triangles.size());
  for (const Count& count : counts) {
    orientation.reoriented_triangles += std::min(count.against, count.triangles - count.against);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Count& count = counts[components.component[t]];
    const bool flip = count.negative != count.positive ? count.negative > count.positive : count.first < 0;
    orientation.reversed[t] = static_cast<std::uint8_t>(components.parity[t] ^ (flip ? 1U : 0U));
  }
  return orientation;
}

}  // namespace trismooth

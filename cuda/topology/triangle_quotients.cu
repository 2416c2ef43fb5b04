#include <limits>

#include "trismooth/cuda/primitives/reduce.cuh"
#include "trismooth/cuda/topology/triangle_quotients.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth::cuda {

namespace {

struct FixedQuotient {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  const std::uint8_t* fixed;

  TRISMOOTH_HOST_DEVICE double operator()(std::uint32_t t) const {
    const auto [a, b, c] = canonical_corners(triangles[t], reversed[t] != 0);
    return fixed[a] != 0 && fixed[b] != 0 && fixed[c] != 0 ? shape_quotient(points[a], points[b], points[c])
                                                           : std::numeric_limits<double>::infinity();
  }
};

struct Smaller {
  TRISMOOTH_HOST_DEVICE double operator()(double a, double b) const { return b < a ? b : a; }
};

}  // namespace

double smallest_fixed_quotient(Context& context, const TriangleList& triangles, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed) {
  return reduce(context, static_cast<std::uint32_t>(triangles.count), std::numeric_limits<double>::infinity(),
                FixedQuotient{triangles, points, reversed, fixed}, Smaller{});
}

}  // namespace trismooth::cuda

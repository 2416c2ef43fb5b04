// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>

#include "trismooth/cuda/primitives/reduce.cuh"
#include "trismooth/cuda/topology/triangle_quotients.h"
#include "trismooth/quality/element.h"

namespace trismooth::cuda {

namespace {

struct FixedQuotient {
  TriangleList triangles;
  const Point2<double>* points;
  const std::uint8_t* reversed;
  const std::uint8_t* fixed;

  TRISMOOTH_HOST_DEVICE double operator()(std::uint32_t t) const {
    const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
    return all_are_fixed(corners, fixed) ? shape_quotient(points_of(corners, points))
                                         : std::numeric_limits<double>::infinity();
  }
};

struct Smaller {
  TRISMOOTH_HOST_DEVICE double operator()(double a, double b) const { return b < a ? b : a; }
};

/// Both counts in one number: inverted triangles above, those without area below. Neither has more than 31 bits.
constexpr unsigned bits_of_count = 32;

struct Invalid {
  TriangleList triangles;
  const Point2<double>* stored;
  const LocalFrame* frame;
  const std::uint8_t* reversed;

  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint32_t t) const {
    const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
    const double quotient = shape_quotient(points_of(corners, [&](std::int32_t v) { return frame->enter(stored[v]); }));
    return quotient < 0 ? std::uint64_t{1} << bits_of_count : quotient == 0 ? 1 : 0;
  }
};

struct Sum {
  TRISMOOTH_HOST_DEVICE std::uint64_t operator()(std::uint64_t a, std::uint64_t b) const { return a + b; }
};

}  // namespace

double smallest_fixed_quotient(Context& context, const TriangleList& triangles, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed) {
  return reduce(context, static_cast<std::uint32_t>(triangles.count), std::numeric_limits<double>::infinity(),
                FixedQuotient{triangles, points, reversed, fixed}, Smaller{});
}

InvalidCounts invalid_triangles(Context& context, const TriangleList& triangles, const Point2<double>* stored,
                                const LocalFrame* frame, const std::uint8_t* reversed) {
  const std::uint64_t counts = reduce(context, static_cast<std::uint32_t>(triangles.count), std::uint64_t{0},
                                      Invalid{triangles, stored, frame, reversed}, Sum{});
  constexpr std::uint64_t lower = (std::uint64_t{1} << bits_of_count) - 1;
  return {static_cast<std::int64_t>(counts >> bits_of_count), static_cast<std::int64_t>(counts & lower)};
}

}  // namespace trismooth::cuda

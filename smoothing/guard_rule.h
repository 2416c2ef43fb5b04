#pragma once

#include <cstdint>

#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

/// An element was made worse: it was valid and is not any more, or is below `threshold` now and below what it was.
/// Written so that a quotient that is no number offends.
constexpr TRISMOOTH_HOST_DEVICE bool offends(double before, double after, double threshold) {
  return (before > 0 && !(after > 0)) || !(after >= threshold || after >= before);
}

/// The shape quotient of the element with these corners (counter-clockwise) and input indices, in canonical corner
/// order: from the corner with the smallest index on. So an element gives the same bits from every one of its vertices.
constexpr TRISMOOTH_HOST_DEVICE double canonical_quotient(Point2<double> a, Point2<double> b, Point2<double> c,
                                                          std::int32_t index_a, std::int32_t index_b,
                                                          std::int32_t index_c) {
  if (index_a <= index_b && index_a <= index_c) {
    return shape_quotient(a, b, c);
  }
  return index_b <= index_c ? shape_quotient(b, c, a) : shape_quotient(c, a, b);
}

}  // namespace trismooth

#include "trismooth/smoothing/guard/guarded_elements.h"

#include <cstddef>
#include <limits>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/guard/guard_rule.h"

namespace trismooth {

GuardedElements::GuardedElements(std::span<const Triangle> triangles, std::span<const QuadraticTriangle> quadratics,
                                 std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> turned)
    : triangles_(triangles), quadratics_(quadratics), reversed_(reversed), turned_(turned) {
  if (!quadratics.empty()) {
    quadratic_of_.resize(triangles.size(), -1);
  }
  for (std::size_t q = 0; q < quadratics.size(); ++q) {
    quadratic_of_[static_cast<std::size_t>(quadratics[q].triangle)] = static_cast<std::int32_t>(q);
  }
}

double GuardedElements::quotient_before(std::span<const Point2<double>> before, std::int32_t element) const {
  return quotient(before, element, is_reversed(element));
}

double GuardedElements::quotient_now(std::span<const Point2<double>> now, std::int32_t element) const {
  return quotient(now, element, is_reversed_now(element));
}

double GuardedElements::worsened(std::span<const Point2<double>> before, std::span<const Point2<double>> now,
                                 std::int32_t element) const {
  return is_spoiled(before, now, element)
             ? -std::numeric_limits<double>::infinity()
             : worsened_quotient(quotient_before(before, element), quotient_now(now, element));
}

double GuardedElements::quotient(std::span<const Point2<double>> points, std::int32_t element, bool reversed) const {
  const auto [a, b, c] = canonical_corners(triangles_[static_cast<std::size_t>(element)], reversed);
  return shape_quotient(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                        points[static_cast<std::size_t>(c)]);
}

/// Whether the element is a quadratic one that was valid and is not any more.
bool GuardedElements::is_spoiled(std::span<const Point2<double>> before, std::span<const Point2<double>> now,
                                 std::int32_t element) const {
  if (quadratic_of_.empty() || quadratic_of_[static_cast<std::size_t>(element)] < 0) {
    return false;
  }
  const Triangle& corners = triangles_[static_cast<std::size_t>(element)];
  const auto& middles = quadratics_[static_cast<std::size_t>(quadratic_of_[static_cast<std::size_t>(element)])].middles;
  const auto is_valid = [&](std::span<const Point2<double>> points, bool reversed) {
    return jacobian_bound(quadratic_nodes(corners, middles, reversed, points)).is_valid();
  };
  return !is_valid(now, is_reversed_now(element)) && is_valid(before, is_reversed(element));
}

}  // namespace trismooth

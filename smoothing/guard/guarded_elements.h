#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/quadratic_quality.h"

namespace trismooth {

/// What the guard measures of the elements of a mesh, of which some may be quadratic: one that was valid by its
/// Jacobian and is not any more offends, however good the triangle of its corners is. Points are of the local frame,
/// one for every vertex, middles too. The views must outlive it.
class GuardedElements {
 public:
  /// `reversed`: of the input, one a triangle. `turned`: as UntanglingResult has it, of what is measured as it is now.
  GuardedElements(std::span<const Triangle> triangles, std::span<const QuadraticTriangle> quadratics,
                  std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> turned);

  /// The quotient of an element as it was, or as it is now.
  double quotient_before(std::span<const Point2<double>> before, std::int32_t element) const;
  double quotient_now(std::span<const Point2<double>> now, std::int32_t element) const;

  /// See GuardedMesh.
  double worsened(std::span<const Point2<double>> before, std::span<const Point2<double>> now,
                  std::int32_t element) const;

 private:
  bool is_reversed(std::int32_t element) const { return reversed_[static_cast<std::size_t>(element)] != 0; }
  bool is_reversed_now(std::int32_t element) const {
    return is_reversed(element) != (!turned_.empty() && turned_[static_cast<std::size_t>(element)] != 0);
  }
  double quotient(std::span<const Point2<double>> points, std::int32_t element, bool reversed) const;
  bool is_spoiled(std::span<const Point2<double>> before, std::span<const Point2<double>> now,
                  std::int32_t element) const;

  std::span<const Triangle> triangles_;
  std::span<const QuadraticTriangle> quadratics_;
  std::span<const std::uint8_t> reversed_;
  std::span<const std::uint8_t> turned_;
  std::vector<std::int32_t> quadratic_of_;  ///< of every triangle, or -1; empty where there are none
};

}  // namespace trismooth

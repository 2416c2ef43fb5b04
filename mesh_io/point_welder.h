#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trismooth {

/// Gives equal points one number: points are numbered from 0 in the order of their first appearance, and are equal
/// where all coordinates compare equal (0 and -0 do). Deterministic; amortised O(1) a point.
class PointWelder {
 public:
  PointWelder();

  /// The number of the point. Coordinates must be finite, distinct points no more than 2^31 - 1: no check.
  std::int32_t weld(const std::array<double, 3>& point);

  /// Distinct points so far.
  std::size_t size() const { return points_.size() / 3; }

  /// x, y, z of every distinct point, each as it first appeared; the welder must not be used after that.
  std::vector<double> take_points() { return std::move(points_); }

 private:
  std::size_t first_slot(const std::array<double, 3>& point) const;
  bool is_at(std::int32_t number, const std::array<double, 3>& point) const;
  void grow();

  std::vector<double> points_;
  /// Open addressing with linear probing: numbers of points, -1 where empty; a power of two in size, half full at most.
  std::vector<std::int32_t> slots_;
};

}  // namespace trismooth

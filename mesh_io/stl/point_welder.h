// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace trismooth {

/// Gives equal points one number: points are numbered from 0 in the order of their first appearance, and are equal
/// where all coordinates compare equal (0 and -0 do). Deterministic; amortised O(1) a point, and O(log n) for points
/// that were chosen to fall into few slots of the hash table.
class PointWelder {
 public:
  PointWelder();

  /// A number of a point, which equal points share. Its lowest bits choose the slot in a welder's table: take the
  /// highest ones to deal out points to several welders.
  static std::uint64_t hash_of(const std::array<double, 3>& point);

  /// The number of the point. Coordinates must be finite, distinct points no more than 2^31 - 1: no check.
  std::int32_t weld(const std::array<double, 3>& point);

  /// Distinct points so far.
  std::size_t size() const { return points_.size() / 3; }

  /// x, y, z of every distinct point, each as it first appeared; the welder must not be used after that.
  std::vector<double> take_points() { return std::move(points_); }

 private:
  using Point = std::array<double, 3>;

  Point at(std::size_t number) const { return {points_[3 * number], points_[3 * number + 1], points_[3 * number + 2]}; }
  std::size_t first_slot(const Point& point) const;
  std::int32_t add(const Point& point);
  bool takes_too_many_steps() const;
  void grow();
  void turn_to_tree();

  std::vector<double> points_;
  /// Open addressing with linear probing: numbers of points, -1 where empty; a power of two in size, half full at most.
  std::vector<std::int32_t> slots_;
  std::size_t welded_ = 0;  ///< calls so far
  std::size_t steps_ = 0;   ///< over slots that others took, so far
  /// In place of the hash table, once that has taken too many steps.
  std::optional<std::map<Point, std::int32_t>> tree_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/splitmix64.h"

namespace trismooth {

/// Points by the squares of the plane that they are in, for those near a place to be found: in an open hash table, as a
/// sort would take several times as long. Each is put in with a reach, which is the size of its squares.
class PointSquares {
 public:
  /// For as many points as `most`.
  explicit PointSquares(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), none) {}

  /// Complexity: constant, where points of the same reach are not closer to each other than about that.
  void add(Point2<double> point, double reach, std::int32_t number) {
    std::size_t slot = first_slot(square_of(point, reach), reach);
    while (slots_[slot] != none) {
      slot = next(slot);
    }
    slots_[slot] = number;
  }

  /// Calls visit(number) for all that have been put in with that reach and are not farther than `distance` (at most the
  /// reach) from the point; for others, too, and maybe more than once: the caller is to look where they are.
  /// Complexity: as that of add().
  template <class Visit>
  void visit_near(Point2<double> point, double distance, double reach, const Visit& visit) const {
    const Square low = square_of({point.x - distance, point.y - distance}, reach);
    const Square middle = square_of(point, reach);
    const Square high = square_of({point.x + distance, point.y + distance}, reach);
    const auto visit_row = [&](double row) {
      visit_square({low.column, row}, reach, visit);
      if (middle.column != low.column) {
        visit_square({middle.column, row}, reach, visit);
      }
      if (high.column != middle.column) {
        visit_square({high.column, row}, reach, visit);
      }
    };
    visit_row(low.row);
    if (middle.row != low.row) {
      visit_row(middle.row);
    }
    if (high.row != middle.row) {
      visit_row(high.row);
    }
  }

 private:
  static constexpr std::int32_t none = -1;

  struct Square {
    double column;
    double row;
  };

  /// Its sides are twice the reach, so that what is near a point is in four squares at most. Where the point is in the
  /// middle of one, rounding may put both ends of what is near beyond its sides: in three columns or rows then.
  static Square square_of(Point2<double> point, double reach) {
    return {number_of(point.x, 2 * reach), number_of(point.y, 2 * reach)};
  }
  /// A whole number as a double: beyond 2^53 it is its own neighbour, and so is the coordinate, which is as coarse.
  static double number_of(double x, double side) {
    const double number = std::floor(x / side);
    return std::isfinite(number) ? number : x;
  }

  template <class Visit>
  void visit_square(Square square, double reach, const Visit& visit) const {
    for (std::size_t slot = first_slot(square, reach); slots_[slot] != none; slot = next(slot)) {
      visit(slots_[slot]);
    }
  }
  std::size_t first_slot(Square square, double reach) const {
    const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number + 0.0); };  // of -0 those of 0
    return splitmix64(splitmix64(splitmix64(bits(reach)) ^ bits(square.column)) ^ bits(square.row)) &
           (slots_.size() - 1);
  }
  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  std::vector<std::int32_t> slots_;  ///< a power of two of them, at most half of them taken
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"

namespace trismooth {

/// How places in the plane in which a mesh is smoothed become the numbers that are stored of its vertices, and where
/// these lie in that plane: the numbers themselves, those of a tilted plane in space, of a map, of few digits. All of
/// it is asked from any thread.
struct StoredImage {
  static constexpr std::size_t most_numbers = 3;  ///< of a vertex

  std::size_t numbers = most_numbers;  ///< of a vertex, in an array of those of all
  /// Where the vertex lies of which these numbers are stored.
  std::function<Point2<double>(std::size_t vertex, const double* stored)> place;
  /// Writes to `moved` what is stored of a vertex that moves from one place to another, before it is rounded. `stored`:
  /// its numbers at `from`.
  std::function<void(const double* stored, Point2<double> from, Point2<double> to, double* moved)> move;
  /// What can be stored of a number. (Near the largest one, the nearest that can be may be beyond it: not finite.)
  std::function<double(double number)> rounded;

  /// What is stored of a number that was `before` and is to be `now`: where it stays, its bits.
  double stored(double before, double now) const { return now == before ? before : rounded(now); }
};

/// The plane itself: x and y of that type are stored.
inline StoredImage plane_image(Storage storage) {
  return {2,
          [](std::size_t /*vertex*/, const double* stored) {
            return Point2<double>{stored[0], stored[1]};
          },
          [](const double* /*stored*/, Point2<double> /*from*/, Point2<double> to, double* moved) {
            moved[0] = to.x;
            moved[1] = to.y;
          },
          [storage](double number) { return rounded_to(storage, number); }};
}

/// The numbers that plane_image() stores of these points.
inline std::vector<double> numbers_of(std::span<const Point2<double>> points) {
  std::vector<double> numbers;
  numbers.reserve(2 * points.size());
  for (const Point2<double> p : points) {
    numbers.insert(numbers.end(), {p.x, p.y});
  }
  return numbers;
}

}  // namespace trismooth

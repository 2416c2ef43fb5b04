// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/ring_kernel.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/base/box.h"

namespace trismooth {

namespace {

/// How often the first edge that has a length is turned by a right angle from the direction of x: to within one.
std::ptrdiff_t quarter_turns(std::span<const Point2<double>> ring) {
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const Point2<double> along = ring[i + 1] - ring[i];
    if (along.x > 0 && along.y >= 0) {
      return 0;
    }
    if (along.x <= 0 && along.y > 0) {
      return 1;
    }
    if (along.x < 0) {
      return 2;
    }
    if (along.y < 0) {
      return 3;
    }
  }
  return 0;
}

/// Leaves of the convex polygon `kernel` what lies left of a line, or on it.
void cut(std::vector<Point2<double>>& kernel, Point2<double> from, Point2<double> to,
         std::vector<Point2<double>>& scratch) {
  const Point2<double> along = to - from;
  scratch.clear();
  for (std::size_t j = 0; j < kernel.size(); ++j) {
    const Point2<double> a = kernel[j];
    const Point2<double> b = kernel[j + 1 == kernel.size() ? 0 : j + 1];
    const double side_a = cross(along, a - from);
    const double side_b = cross(along, b - from);
    if (side_a >= 0) {
      scratch.push_back(a);
    }
    if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) {
      const double part = side_a / (side_a - side_b);
      scratch.push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    }
  }
  kernel.swap(scratch);
}

}  // namespace

std::optional<Point2<double>> kernel_centre(std::span<const Point2<double>> ring, std::vector<Point2<double>>& scratch,
                                            std::span<const Chord> chords) {
  Box box;
  for (const Point2<double> p : ring) {
    box.add(p);
  }
  const auto& [low, high] = box;
  // The kernel is the bounding box cut by the line of every edge.
  std::vector<Point2<double>> kernel{low, {high.x, low.y}, high, {low.x, high.y}};
  // A ring that is turned by a right angle has the same corners in the same order: their sum is rounded alike.
  std::rotate(kernel.begin(), kernel.begin() + quarter_turns(ring), kernel.end());
  for (std::size_t i = 0; i < ring.size() && !kernel.empty(); ++i) {
    cut(kernel, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], scratch);
  }
  for (std::size_t i = 0; i < chords.size() && !kernel.empty(); ++i) {
    cut(kernel, chords[i][0], chords[i][1], scratch);
  }
  if (kernel.size() < 3) {
    return std::nullopt;
  }
  Point2<double> sum{0, 0};
  for (const Point2<double> p : kernel) {
    sum.x += p.x;
    sum.y += p.y;
  }
  const auto count = static_cast<double>(kernel.size());
  return Point2<double>{sum.x / count, sum.y / count};
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

/// The smallest of many values of the Jacobian of a triangle of six nodes, from the shape functions. `at(node, axis)`
/// is a coordinate: nodes 0 to 2 are the corners, counter-clockwise, 3 to 5 the middles behind them.
template <class At>
double smallest_jacobian_sample(const At& at) {
  constexpr int steps = 20;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double l1 = double(i) / steps;
      const double l2 = double(j) / steps;
      const double l0 = 1 - l1 - l2;
      const std::array<double, 6> by_l1{1 - 4 * l0, 4 * l1 - 1, 0, 4 * (l0 - l1), 4 * l2, -4 * l2};
      const std::array<double, 6> by_l2{1 - 4 * l0, 0, 4 * l2 - 1, -4 * l1, 4 * l1, 4 * (l0 - l2)};
      double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
      for (std::size_t node = 0; node < 6; ++node) {
        x1 += by_l1[node] * at(node, 0);
        y1 += by_l1[node] * at(node, 1);
        x2 += by_l2[node] * at(node, 0);
        y2 += by_l2[node] * at(node, 1);
      }
      smallest = std::min(smallest, x1 * y2 - y1 * x2);
    }
  }
  return smallest;
}

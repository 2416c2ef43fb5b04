// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"

namespace trismooth {

constexpr TRISMOOTH_HOST_DEVICE Point2<double> times(double factor, Point2<double> p) {
  return {factor * p.x, factor * p.y};
}

constexpr TRISMOOTH_HOST_DEVICE Point2<double> plus(Point2<double> a, Point2<double> b) {
  return {a.x + b.x, a.y + b.y};
}

/// A symmetric matrix of unknowns that hang together by weights, in memory of the host or of a device: row v times x is
/// diagonal[v] x[v] minus the weighted sum of the unknowns that it is linked with.
struct GraphView {
  const std::int64_t* offsets;  ///< row v has links offsets[v] .. offsets[v + 1]
  const std::int32_t* linked;   ///< the other unknowns
  const double* weights;        ///< the same from both sides
  const double* diagonal;       ///< of a mesh: the sum of the weights of a row, and of those to what is known
  std::int32_t size;

  TRISMOOTH_HOST_DEVICE Point2<double> row_times(std::int32_t v, const Point2<double>* x) const {
    Point2<double> sum = times(diagonal[v], x[v]);
    for (std::int64_t i = offsets[v]; i < offsets[v + 1]; ++i) {
      sum = sum - times(weights[i], x[linked[i]]);
    }
    return sum;
  }
};

/// Rows of weighted sums of unknowns.
struct RowsView {
  const std::int64_t* offsets;
  const std::int32_t* unknowns;
  const double* weights;
  std::int32_t size;

  TRISMOOTH_HOST_DEVICE Point2<double> row_times(std::int32_t row, const Point2<double>* x) const {
    Point2<double> sum{0, 0};
    for (std::int64_t i = offsets[row]; i < offsets[row + 1]; ++i) {
      sum = plus(sum, times(weights[i], x[unknowns[i]]));
    }
    return sum;
  }
};

/// GraphLaplacian::Level.
struct LevelView {
  GraphView graph;
  RowsView spread;
  RowsView gather;
};

}  // namespace trismooth

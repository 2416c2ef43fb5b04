// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"

namespace trismooth {

/// Two thirds of the way from v to the mean of its neighbours n_i weighted by edge length |n_i - v|: v plus two thirds
/// of the weighted mean of the edges, summed in ring order. Long edges pull more, so lengths even out. All of the way
/// would be too far, since the edges that v comes from get longer on the way: in a round ring that ends half as far
/// beyond the place where v would stay. There two thirds reach it, and without them sweeps of Form A go to and fro for
/// ever. No number where all lengths are 0.
template <class T, class Ring>
TRISMOOTH_HOST_DEVICE Point2<T> length_weighted_position(Point2<T> position, const Ring& ring) {
  T lengths = 0;
  Point2<T> sum{0, 0};
  for (int i = 0; i < ring.size(); ++i) {
    const Point2<T> edge = ring[i] - position;
    const T length = std::sqrt(squared_length(edge));
    lengths += length;
    sum.x += length * edge.x;
    sum.y += length * edge.y;
  }
  const T step = T(2) / (T(3) * lengths);
  return {position.x + sum.x * step, position.y + sum.y * step};
}

/// The place of length_weighted_position().
struct LengthWeightedMean {
  template <class T, class Ring>
  static TRISMOOTH_HOST_DEVICE Point2<T> target(Point2<T> position, const Ring& ring) {
    return length_weighted_position(position, ring);
  }
  /// Of the two neighbours on the line.
  static TRISMOOTH_HOST_DEVICE double along_line(double before, double own, double after) {
    const double back = own - before;
    const double on = after - own;
    return own + 2 * (on * on - back * back) / (3 * (back + on));
  }
};

/// Length-weighted Laplacian smoothing (T. D. Blacker and M. B. Stephenson 1991), with the test of
/// the smart one: that alone keeps it from making elements worse.
struct WeightedLaplacian : SmartMethod<LengthWeightedMean> {
  static constexpr Method method = Method::weighted;
};

template <>
struct UpdateOf<Method::weighted> : UpdateByRing<WeightedLaplacian> {};

}  // namespace trismooth

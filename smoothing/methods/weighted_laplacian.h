#pragma once

#include <cmath>

#include "trismooth/smoothing/methods/one_ring_update.h"

namespace trismooth {

/// Weighted Laplacian smoothing (Blacker and Stephenson 1991): to the mean of the neighbours n_i, weighted by inverse
/// edge length 1 / |n_i - v|, summed in ring order. A vertex that lies on a neighbour stays there.
struct WeightedLaplacian {
  template <class T, class Ring>
  static TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    T weights = 0;
    Point2<T> sum{0, 0};
    for (int i = 0; i < ring.size(); ++i) {
      const Point2<T> neighbour = ring[i];
      // An infinite weight (a zero length) makes the quotient below no number: no move.
      const T weight = T(1) / std::sqrt(squared_length(neighbour - position));
      weights += weight;
      sum.x += weight * neighbour.x;
      sum.y += weight * neighbour.y;
    }
    return move_to(position, Point2<T>{sum.x / weights, sum.y / weights});
  }
};

}  // namespace trismooth

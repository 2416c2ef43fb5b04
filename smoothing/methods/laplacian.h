#pragma once

#include "trismooth/smoothing/methods/one_ring_update.h"

namespace trismooth {

/// Plain Laplacian smoothing (Herrmann 1976): to the mean of the neighbours, whatever that does to the triangles.
struct Laplacian {
  /// Where the vertex is to go.
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Point2<T> target(Point2<T> /*position*/, const Ring& ring) {
    return laplacian_position<T>(ring);
  }

  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    return move_to(position, target(position, ring));
  }
};

}  // namespace trismooth

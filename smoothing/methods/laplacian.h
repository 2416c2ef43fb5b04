#pragma once

#include "trismooth/smoothing/methods/one_ring_update.h"

namespace trismooth {

/// Plain Laplacian smoothing (Herrmann 1976): to the mean of the neighbours, whatever that does to the triangles.
struct Laplacian {
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    return move_to(position, laplacian_position<T>(ring));
  }
};

}  // namespace trismooth

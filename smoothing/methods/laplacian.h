// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/methods/one_ring_update.h"

namespace trismooth {

/// Plain Laplacian smoothing (Herrmann 1976): to the mean of the neighbours, whatever that does to the triangles.
struct Laplacian {
  static constexpr Method method = Method::laplacian;
  static constexpr bool is_smart = false;

  /// Where the vertex is to go.
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Point2<T> target(Point2<T> /*position*/, const Ring& ring) {
    return laplacian_position<T>(ring);
  }
  /// The middle between the neighbours on the line.
  static constexpr TRISMOOTH_HOST_DEVICE double along_line(double before, double /*own*/, double after) {
    return before + 0.5 * (after - before);
  }

  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    return move_to(position, target(position, ring));
  }
};

template <>
struct UpdateOf<Method::laplacian> : UpdateByRing<Laplacian> {};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/methods/laplacian.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth {

/// The smallest shape quotient of the elements around `position`. Without branches, here and below: on a CPU a wrong
/// guess costs more than the divisions that an early exit saves.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE T worst_quotient(Point2<T> position, const Ring& ring) {
  T worst = 1;  // no quotient is above 1 / (2 sqrt(3))
  for_ring_quotients(position, ring, [&](T quotient) { worst = quotient < worst ? quotient : worst; });
  return worst;
}

/// Whether the smallest shape quotient of the elements around `position` is larger than `bound`, that is, every one of
/// them is. A quotient that is no number is not.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE bool is_better_than(T bound, Point2<T> position, const Ring& ring) {
  bool better = true;
  for_ring_quotients(position, ring, [&](T quotient) { better &= quotient > bound; });
  return better;
}

/// How many of the triangles around `position` are inverted.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE int inverted_triangles(Point2<T> position, const Ring& ring) {
  int inverted = 0;
  for_ring_quotients(position, ring, [&](T quotient) { inverted += quotient < T(0) ? 1 : 0; });
  return inverted;
}

/// To `target` if and only if the smallest quality of the vertex's triangles gets strictly larger there than `before`,
/// and no more of them are inverted than at `position`.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE Move<T> smart_move(Point2<T> position, Point2<T> target, const Ring& ring, T before) {
  if (!is_better_than(before, target, ring)) {
    return stay(position);
  }
  // Where nothing was inverted, a larger minimum says that nothing is.
  if (before < T(0) && inverted_triangles(target, ring) > inverted_triangles(position, ring)) {
    return stay(position);
  }
  return move_to(position, target);
}

/// A method that moves a vertex to Place::target() by the rule of smart_move(), and one that slides to
/// Place::along_line().
template <class Place>
struct SmartMethod {
  static constexpr bool is_smart = true;

  /// Where the vertex is to go if that is better.
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Point2<T> target(Point2<T> position, const Ring& ring) {
    return Place::target(position, ring);
  }
  static constexpr TRISMOOTH_HOST_DEVICE double along_line(double before, double own, double after) {
    return Place::along_line(before, own, after);
  }

  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring) {
    return update(position, ring, worst_quotient(position, ring));
  }

  /// update() where `before`, the smallest quotient around the vertex, is known: the paper's stored minimum.
  template <class T, class Ring>
  static constexpr TRISMOOTH_HOST_DEVICE Move<T> update(Point2<T> position, const Ring& ring, T before) {
    return smart_move(position, target(position, ring), ring, before);
  }
};

/// Smart Laplacian smoothing (the paper, section 3.3.4): to the mean of the neighbours if and only if the smallest
/// quality of the vertex's triangles gets strictly larger, and no more of them are inverted than before.
struct SmartLaplacian : SmartMethod<Laplacian> {
  static constexpr Method method = Method::smart;
};

template <>
struct UpdateOf<Method::smart> : UpdateByRing<SmartLaplacian> {};

}  // namespace trismooth

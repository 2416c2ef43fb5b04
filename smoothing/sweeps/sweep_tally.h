// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"

namespace trismooth {

/// What a part of a sweep did. All of it is independent of the order in which parts are joined, so it is the same for
/// every number of threads and on every backend. `Count` suffices for the vertices of the part.
template <class T, class Count = std::int64_t>
struct SweepTally {
  Count evaluated = 0;
  Count moved = 0;
  bool within_tolerance = true;
  T max_relative_squared = 0;  ///< of move^2 * k / sum |n_i - v|^2

  constexpr TRISMOOTH_HOST_DEVICE void join(const SweepTally& other) {
    evaluated += other.evaluated;
    moved += other.moved;
    within_tolerance = within_tolerance && other.within_tolerance;
    max_relative_squared =
        other.max_relative_squared > max_relative_squared ? other.max_relative_squared : max_relative_squared;
  }
};

/// How far a vertex with k neighbours n_i moved, v being where it was.
template <class T>
struct MoveLength {
  T moved;  ///< move^2 * k
  T sum;    ///< sum |n_i - v|^2, in ring order: VertexMove::squares

  constexpr TRISMOOTH_HOST_DEVICE bool is_within(T tolerance) const { return moved <= tolerance * tolerance * sum; }
  constexpr TRISMOOTH_HOST_DEVICE T relative_squared() const { return sum > 0 ? moved / sum : T(0); }
};

template <class T>
constexpr TRISMOOTH_HOST_DEVICE MoveLength<T> length_of_move(Point2<T> from, Point2<T> to, int neighbours, T sum) {
  return {squared_length(to - from) * static_cast<T>(neighbours), sum};
}

/// Whether a move may be longer, relative to its neighbourhood, than `longest_squared`: only then is its quotient
/// divided. Exact: if the rounded moved / sum exceeds `longest_squared`, then moved > longest_squared * sum, and
/// rounding the product cannot bring it above `moved`, which is a number itself.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE bool may_be_longer(const MoveLength<T>& length, T longest_squared) {
  return length.moved >= longest_squared * length.sum;
}

/// Counts a move. It is within the tolerance where move^2 * k <= tolerance^2 * sum |n_i - v|^2, in working precision.
template <class T, class Count>
constexpr TRISMOOTH_HOST_DEVICE void add_move(SweepTally<T, Count>& tally, const MoveLength<T>& length, T tolerance) {
  ++tally.moved;
  tally.within_tolerance = tally.within_tolerance && length.is_within(tolerance);
  if (may_be_longer(length, tally.max_relative_squared)) {
    const T relative = length.relative_squared();
    tally.max_relative_squared = relative > tally.max_relative_squared ? relative : tally.max_relative_squared;
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

/// What a method says of vertices side by side, a vertex a lane. What is yes or no is 1 or 0, in numbers as wide as the
/// others.
template <class T>
struct LaneMoves {
  static constexpr int lanes = 32;

  alignas(64) T target_x[lanes] = {};
  alignas(64) T target_y[lanes] = {};
  alignas(64) T squares[lanes] = {};    ///< see VertexMove
  alignas(64) T moves[lanes] = {};      ///< to the target
  alignas(64) T undecided[lanes] = {};  ///< that is to be asked for alone
};

/// LaneMoves with the rings of their vertices, which are of one size. Loops over lanes do in one instruction what a
/// register has room for.
template <class T>
struct RingLanes : LaneMoves<T> {
  using LaneMoves<T>::lanes;
  /// Loops go over so many at a time: as many as fill the widest register, or two or four narrower ones.
  static constexpr int at_once = 8;
  static constexpr int smallest_ring = 3;
  static constexpr int largest_ring = 9;
  static constexpr int largest_of_quadrilaterals = 6;  ///< those have a vertex opposite for each neighbour

  static constexpr bool holds(int ring_size, RingKind kind) {
    return ring_size >= smallest_ring && kind != RingKind::both &&
           ring_size <= (kind == RingKind::triangles ? largest_ring : largest_of_quadrilaterals);
  }

  // x[i] of neighbour i in ring order; of quadrilaterals the vertices opposite are behind these. Lanes beyond those in
  // use hold anything.
  static constexpr int most_vertices = std::max(largest_ring, 2 * largest_of_quadrilaterals);
  alignas(64) T x[most_vertices][lanes] = {};
  alignas(64) T y[most_vertices][lanes] = {};
  alignas(64) T position_x[lanes] = {};
  alignas(64) T position_y[lanes] = {};
};

}  // namespace trismooth

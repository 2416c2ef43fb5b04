// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "trismooth/cuda/update/reciprocals.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/methods/weighted_laplacian.h"
#include "trismooth/smoothing/rings/ring_elements.h"

/// The update of one vertex by a team of threads, an element each: where few vertices are to be evaluated, their number
/// does not fill the GPU, and what counts is how soon one of them is done. Several teams share a warp; all threads of
/// the warp call these functions, and all threads of a team with the same arguments. A team without a vertex has a ring
/// of size 0, and its result means nothing.
namespace trismooth::cuda {

inline constexpr int team_size = 8;
/// Most rings have no more neighbours than a team deals out in so many rounds; rings of more than twice that are left
/// to one thread.
inline constexpr int usual_rounds = 8 / team_size;
/// Teams of a warp.
inline constexpr int teams = 32 / team_size;
/// So many vertices of a warp are evaluated by teams, more by one thread each.
inline constexpr int few_for_teams = 8;

/// The place of the thread in its team.
__device__ inline int team_lane() {
  return static_cast<int>(threadIdx.x % team_size);
}

/// A ring dealt out to a team: neighbour i is with thread i % team_size, in round i / team_size. What is beyond the
/// ring's end is the last element once more.
template <class T, int rounds>
struct TeamRing {
  static constexpr int capacity = rounds * team_size;

  Point2<T> neighbours[rounds];
  Point2<T> followers[rounds];  ///< the neighbours after them
  int size;                     ///< at most the capacity

  /// `position(i)` is that of neighbour i.
  template <class Position>
  __device__ __forceinline__ TeamRing(int ring_size, const Position& position) : size(ring_size) {
    const int last = max(ring_size - 1, 0);
#pragma unroll
    for (int round = 0; round < rounds; ++round) {
      const int i = min(round * team_size + team_lane(), last);
      neighbours[round] = position(i);
      followers[round] = position(i < last ? i + 1 : 0);
    }
  }

  __device__ bool counts(int round) const {
    return round * team_size + team_lane() < size;
  }
};

/// That of a ring with quadrilaterals.
template <class T, int rounds>
struct MixedTeamRing : TeamRing<T, rounds> {
  Point2<T> opposites[rounds];  ///< of the elements that are quadrilaterals
  bool is_quadrilateral[rounds];

  template <MixedRing Ring>
  __device__ __forceinline__ MixedTeamRing(int ring_size, const Ring& ring)
      : TeamRing<T, rounds>(ring_size, [&](int i) { return ring[i]; }) {
    const int last = max(ring_size - 1, 0);
#pragma unroll
    for (int round = 0; round < rounds; ++round) {
      const int i = min(round * team_size + team_lane(), last);
      is_quadrilateral[round] = ring.is_quadrilateral(i);
      opposites[round] = ring[is_quadrilateral[round] ? ring_size + i : i];
    }
  }
};

/// Where a team has a ring from: a MixedRing, or a function that answers the position of neighbour i.
template <class T, int rounds, class Source>
__device__ __forceinline__ auto team_ring(int size, const Source& source) {
  if constexpr (MixedRing<Source>) {
    return MixedTeamRing<T, rounds>(size, source);
  } else {
    return TeamRing<T, rounds>(size, source);
  }
}

/// The sum in ring order of value(round) over the elements: `nothing` is what those beyond the end add, a zero that
/// leaves every sum as it is.
template <class T, int rounds, class Value>
__device__ __forceinline__ T sum_in_order(const TeamRing<T, rounds>& ring, T nothing, const Value& value) {
  T sum{};
#pragma unroll
  for (int round = 0; round < rounds; ++round) {
    const T own = ring.counts(round) ? value(round) : nothing;
#pragma unroll
    for (int lane = 0; lane < team_size; ++lane) {
      const T next = __shfl_sync(0xffffffffU, own, lane, team_size);
      sum = round == 0 && lane == 0 ? next : sum + next;
    }
  }
  return sum;
}

/// laplacian_position(), by the same operations in the same order as one thread.
template <class T, int rounds>
__device__ __forceinline__ Point2<T> laplacian_position(const TeamRing<T, rounds>& ring) {
  const T weight = small_reciprocal<T>(ring.size);
  return {sum_in_order(ring, -T(0), [&](int round) { return ring.neighbours[round].x; }) * weight,
          sum_in_order(ring, -T(0), [&](int round) { return ring.neighbours[round].y; }) * weight};
}

/// Where a smart method looks.
template <class T, int rounds>
__device__ __forceinline__ Point2<T> team_target(Laplacian, Point2<T> /*position*/, const TeamRing<T, rounds>& ring) {
  return laplacian_position(ring);
}
template <class T, int rounds>
__device__ __forceinline__ Point2<T> team_target(LengthWeightedMean, Point2<T> position,
                                                 const TeamRing<T, rounds>& ring) {
  Point2<T> edges[rounds];
  T own_lengths[rounds];
#pragma unroll
  for (int round = 0; round < rounds; ++round) {
    edges[round] = ring.neighbours[round] - position;
    own_lengths[round] = std::sqrt(squared_length(edges[round]));
  }
  const T lengths = sum_in_order(ring, T(0), [&](int round) { return own_lengths[round]; });
  // One thread begins with zeros, which are positive.
  const T x = T(0) + sum_in_order(ring, -T(0), [&](int round) { return own_lengths[round] * edges[round].x; });
  const T y = T(0) + sum_in_order(ring, -T(0), [&](int round) { return own_lengths[round] * edges[round].y; });
  const T step = T(2) / (T(3) * lengths);
  return {position.x + x * step, position.y + y * step};
}

/// The sum of a move's tally.
template <class T, int rounds>
__device__ __forceinline__ T sum_of_squares(Point2<T> position, const TeamRing<T, rounds>& ring) {
  return sum_in_order(ring, T(0), [&](int round) { return squared_length(ring.neighbours[round] - position); });
}

/// The quotient of the thread's element.
template <class T, int rounds>
__device__ __forceinline__ T team_quotient(Point2<T> position, const TeamRing<T, rounds>& ring, int round) {
  return shape_quotient(TriangleCorner<RingSpoke<T>>{spoke_to(ring.neighbours[round], position),
                                                     spoke_to(ring.followers[round], position)});
}

template <class T, int rounds>
__device__ __forceinline__ T team_quotient(Point2<T> position, const MixedTeamRing<T, rounds>& ring, int round) {
  const RingSpoke<T> next = spoke_to(ring.neighbours[round], position);
  const RingSpoke<T> previous = spoke_to(ring.followers[round], position);
  if (!ring.is_quadrilateral[round]) {
    return shape_quotient(TriangleCorner<RingSpoke<T>>{next, previous});
  }
  return shape_quotient(QuadrilateralCorner<RingSpoke<T>>{next, spoke_to(ring.opposites[round], position), previous});
}

template <class Place, class T, class Ring>
__device__ __forceinline__ Move<T> update_by_team(SmartMethod<Place>, Point2<T> position, const Ring& ring) {
  constexpr int rounds = Ring::capacity / team_size;
  constexpr unsigned all_lanes = 0xffffffffU;
  const unsigned team = ((1U << team_size) - 1) << (threadIdx.x % 32 / team_size * team_size);
  const Point2<T> target = team_target(Place{}, position, ring);
  T own_before[rounds];
  T own_after[rounds];
  T before = 1;
#pragma unroll
  for (int round = 0; round < rounds; ++round) {
    own_before[round] = team_quotient(position, ring, round);
    own_after[round] = team_quotient(target, ring, round);
    before = own_before[round] < before ? own_before[round] : before;
  }
#pragma unroll
  for (int distance = team_size / 2; distance > 0; distance /= 2) {
    const T other = __shfl_xor_sync(all_lanes, before, distance, team_size);
    before = other < before ? other : before;
  }
  bool better = true;
#pragma unroll
  for (int round = 0; round < rounds; ++round) {
    better = better && own_after[round] > before;
  }
  better = (__ballot_sync(all_lanes, better) & team) == team;
  if (__any_sync(all_lanes, better && before < T(0)) != 0) {
    int more = 0;
#pragma unroll
    for (int round = 0; round < rounds; ++round) {
      const bool counts = ring.counts(round);
      more += __popc(__ballot_sync(all_lanes, counts && own_after[round] < T(0)) & team);
      more -= __popc(__ballot_sync(all_lanes, counts && own_before[round] < T(0)) & team);
    }
    better = better && (!(before < T(0)) || more <= 0);
  }
  return better ? move_to(position, target) : stay(position);
}

template <class T, int rounds>
__device__ __forceinline__ Move<T> update_by_team(Laplacian, Point2<T> position, const TeamRing<T, rounds>& ring) {
  return move_to(position, laplacian_position(ring));
}

/// The update of a vertex, and the sum of its tally where one of the warp's vertices moves. `size` of its ring, 0 where
/// there is no vertex; `source`: see team_ring(); `alone()`: the update by one thread, for a ring that is too large for
/// a team.
template <class Update, class T, class Source, class Alone>
__device__ __forceinline__ VertexMove<T> evaluate_by_team(Point2<T> position, int size, const Source& source,
                                                          const Alone& alone) {
  constexpr unsigned all_lanes = 0xffffffffU;
  VertexMove<T> result{};
  const auto with_rounds = [&]<int rounds>(std::integral_constant<int, rounds>) {
    const bool fits = size <= rounds * team_size;
    const auto ring = team_ring<T, rounds>(fits ? size : 0, source);
    result.move = update_by_team(Update{}, position, ring);
    if (__any_sync(all_lanes, size > 0 && result.move.moved) != 0) {
      result.squares = sum_of_squares(position, ring);
    }
    if (!fits) {
      result = alone();
    }
  };
  if constexpr (MixedRing<Source>) {
    // Those of more neighbours are not left to teams.
    with_rounds(std::integral_constant<int, usual_rounds>{});
  } else if (__any_sync(all_lanes, size > usual_rounds * team_size) == 0) {
    with_rounds(std::integral_constant<int, usual_rounds>{});
  } else {
    with_rounds(std::integral_constant<int, 2 * usual_rounds>{});
  }
  result.move.moved = size > 0 && result.move.moved;
  return result;
}

}  // namespace trismooth::cuda

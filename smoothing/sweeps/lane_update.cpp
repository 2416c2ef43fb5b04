// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/lane_update.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include "trismooth/base/machine/compiled_for.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/sweeps/quotient_filter.h"

// Loops over lanes, which call the methods' own functions for each.
namespace trismooth {

namespace {

/// The vertices of the ring in a lane.
template <class T, int Size>
struct RingInLane {
  const RingLanes<T>& rings;
  int lane;

  static constexpr int size() { return Size; }
  constexpr Point2<T> operator[](int i) const { return {rings.x[i][lane], rings.y[i][lane]}; }
};

template <class T, int Size>
struct TrianglesInLane : RingInLane<T, Size> {};

/// A MixedRing.
template <class T, int Size>
struct QuadrilateralsInLane : RingInLane<T, Size> {
  static constexpr bool is_quadrilateral(int /*i*/) { return true; }
};

/// That of ring_elements.h, written out: GCC does so itself with loops over smaller rings alone.
template <class T, int Size, class NodeAt, class Visit>
[[gnu::always_inline]] inline void for_elements_around(const QuadrilateralsInLane<T, Size>& /*ring*/,
                                                       const NodeAt& node, const Visit& visit) {
  using Node = decltype(node(0));
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) {
    (visit(QuadrilateralCorner<Node>{node(i), node(Size + i), node((i + 1) % Size)}), ...);
  }
  (std::make_integer_sequence<int, Size>());
}

template <class T>
[[gnu::always_inline]] inline Point2<T> position_in_lane(int lane, const RingLanes<T>& rings) {
  return {rings.position_x[lane], rings.position_y[lane]};
}

template <class T, class Ring>
[[gnu::always_inline]] inline void put(int lane, const Ring& ring, Point2<T> target, bool moves, bool is_undecided,
                                       RingLanes<T>& rings) {
  rings.target_x[lane] = target.x;
  rings.target_y[lane] = target.y;
  rings.squares[lane] = squares_around(position_in_lane(lane, rings), ring);
  rings.moves[lane] = moves ? T(1) : T(0);
  rings.undecided[lane] = is_undecided ? T(1) : T(0);
}

/// The method's update of one vertex, but for smart ones around inverted triangles: these take a second look.
template <class Update, class T, class Ring>
[[gnu::always_inline]] inline void update_lane(int lane, const Ring& ring, RingLanes<T>& rings) {
  const Point2<T> position = position_in_lane(lane, rings);
  const Point2<T> target = Update::target(position, ring);
  bool moves = is_move(position, target);
  bool is_undecided = false;
  if constexpr (Update::is_smart) {
    const T before = worst_quotient(position, ring);
    moves &= is_better_than(before, target, ring);
    is_undecided = before < T(0);
  }
  put(lane, ring, target, moves, is_undecided, rings);
}

/// Whether there is a filter for it.
template <class Update, class T, class Ring>
constexpr bool has_filter() {
  return Update::is_smart && MixedRing<Ring> && std::is_same_v<T, double>;
}

/// update_lane() as far as a filter tells.
template <class Update, class Ring>
[[gnu::always_inline]] inline void filter_lane(int lane, const Ring& ring, RingLanes<double>& rings) {
  const Point2<double> position = position_in_lane(lane, rings);
  const Point2<double> target = Update::target(position, ring);
  const bool is_elsewhere = is_move(position, target);
  const auto [gain, band] = quotient_filter::gain(position, target, ring);
  put(lane, ring, target, is_elsewhere & (gain > band), is_elsewhere & !(std::abs(gain) > band), rings);
}

template <class T>
[[gnu::always_inline]] inline bool any_undecided(int begin, const RingLanes<T>& rings) {
  int found = 0;
  for (int lane = 0; lane < rings.at_once; ++lane) {
    found |= rings.undecided[begin + lane] != T(0) ? 1 : 0;
  }
  return found != 0;
}

template <class Update, class Ring, class T>
[[gnu::always_inline]] inline void update_rings(int count, RingLanes<T>& rings) {
  // To the end of a register: a rest would need code of its own.
  constexpr int at_once = RingLanes<T>::at_once;
  const int end = (count + at_once - 1) / at_once * at_once;
  if constexpr (has_filter<Update, T, Ring>()) {
    // Where the filter cannot tell once, as in a grid that is even, it is not asked again: vertices come with those
    // beside them.
    bool is_filtered = true;
    for (int begin = 0; begin < end; begin += at_once) {
      if (is_filtered) {
        for (int lane = begin; lane < begin + at_once; ++lane) {
          filter_lane<Update>(lane, Ring{{rings, lane}}, rings);
        }
        is_filtered = !any_undecided(begin, rings);
      }
      if (!is_filtered) {
        for (int lane = begin; lane < begin + at_once; ++lane) {
          update_lane<Update>(lane, Ring{{rings, lane}}, rings);
        }
      }
    }
  } else {
    for (int lane = 0; lane < end; ++lane) {
      update_lane<Update>(lane, Ring{{rings, lane}}, rings);
    }
  }
}

template <class Update, template <class, int> class Ring, class T, int... offset>
[[gnu::always_inline]] inline void update_rings_of(int size, int count, RingLanes<T>& rings,
                                                   std::integer_sequence<int, offset...> /*sizes*/) {
  constexpr int smallest = RingLanes<T>::smallest_ring;
  (void)((size == smallest + offset && (update_rings<Update, Ring<T, smallest + offset>>(count, rings), true)) || ...);
}

template <class Update, class T>
[[gnu::always_inline]] inline void update_lanes(int size, RingKind kind, int count, RingLanes<T>& rings) {
  using Rings = RingLanes<T>;
  constexpr int sizes = Rings::largest_ring - Rings::smallest_ring + 1;
  constexpr int sizes_of_quadrilaterals = Rings::largest_of_quadrilaterals - Rings::smallest_ring + 1;
  if (kind == RingKind::triangles) {
    update_rings_of<Update, TrianglesInLane>(size, count, rings, std::make_integer_sequence<int, sizes>());
  } else {
    update_rings_of<Update, QuadrilateralsInLane>(size, count, rings,
                                                  std::make_integer_sequence<int, sizes_of_quadrilaterals>());
  }
}

}  // namespace

template <class T>
LaneUpdate<T> lane_update(Method method, InstructionSet instructions) {
  return visit_method(MethodInUse<T>{method}, [&]<class Update>(const Update& /*update*/) -> LaneUpdate<T> {
    if constexpr (requires { Update::is_smart; }) {
      return compiled_for<update_lanes<Update, T>>(instructions);
    } else {
      return nullptr;
    }
  });
}

template LaneUpdate<float> lane_update(Method, InstructionSet);
template LaneUpdate<double> lane_update(Method, InstructionSet);

}  // namespace trismooth

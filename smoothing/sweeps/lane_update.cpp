// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/lane_update.h"

#include <utility>

#include "trismooth/base/machine/compiled_for.h"
#include "trismooth/smoothing/methods/methods.h"

// One loop, which calls the methods' own functions for each lane.
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

/// The method's update of one vertex, but for smart ones around inverted triangles: these take a second look.
template <class Update, class T, class Ring>
[[gnu::always_inline]] inline void update_lane(int lane, const Ring& ring, RingLanes<T>& rings) {
  const Point2<T> position{rings.position_x[lane], rings.position_y[lane]};
  const Point2<T> target = Update::target(position, ring);
  bool moves = is_move(position, target);
  bool is_undecided = false;
  if constexpr (Update::is_smart) {
    const T before = worst_quotient(position, ring);
    moves &= is_better_than(before, target, ring);
    is_undecided = before < T(0);
  }
  rings.target_x[lane] = target.x;
  rings.target_y[lane] = target.y;
  rings.squares[lane] = squares_around(position, ring);
  rings.moves[lane] = moves ? T(1) : T(0);
  rings.undecided[lane] = is_undecided ? T(1) : T(0);
}

template <class Update, class Ring, class T>
[[gnu::always_inline]] inline void update_rings(int count, RingLanes<T>& rings) {
  // To the end of a register: a rest would need code of its own.
  constexpr int at_once = RingLanes<T>::at_once;
  const int end = (count + at_once - 1) / at_once * at_once;
  for (int lane = 0; lane < end; ++lane) {
    update_lane<Update>(lane, Ring{{rings, lane}}, rings);
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"

namespace trismooth::cuda {

/// Calls visit(i) for i = 0, 1, ..., unrolled: for the first `always` of them, then as far as i < end.
template <int capacity, int always, int i = 0, class Visit>
__device__ __forceinline__ void unrolled(int end, const Visit& visit) {
  if constexpr (i < capacity) {
    if (i < always || i < end) {
      visit(std::integral_constant<int, i>{});
      unrolled<capacity, always, i + 1>(end, visit);
    }
  }
}

/// The positions of a ring of up to `capacity` neighbours in registers, where loops over them are unrolled. A loop
/// leaves where the longest ring of the warp ends, together for all threads, which have rings of like size; shorter
/// rings repeat their first neighbour, so that they are closed.
template <class T, int most>
struct RegisterRing {
  static constexpr int capacity = most;
  static constexpr int smallest = 4;  ///< loops leave no sooner

  Point2<T> neighbours[capacity];
  int size;
  int longest;  ///< of the warp's rings

  /// Calls visit(i) for each place up to the end of the longest ring.
  template <class Visit>
  __device__ __forceinline__ void for_places(const Visit& visit) const {
    unrolled<capacity, smallest>(longest, visit);
  }
};

/// Of the rings that one thread updates in registers: those of more neighbours are left to teams.
inline constexpr int largest_register_ring = 12;

/// Fetches the ring with this record into registers. All threads of the warp call it; those that are not `active`, or
/// whose ring is longer than the capacity, fetch nothing: their ring has size 0.
template <class T, int capacity, class Slot>
__device__ __forceinline__ void fetch_ring(std::int32_t v, const RingRecord<Slot>& record, bool active,
                                           const std::int32_t* long_rings, const PointArray<T>& points,
                                           RegisterRing<T, capacity>& ring) {
  constexpr int smallest = RegisterRing<T, capacity>::smallest;
  constexpr int slots = RingRecord<Slot>::slots;
  const bool is_long = record.is_long();
  const int size = active ? record.ring_size() : 0;
  ring.size = size <= capacity ? size : 0;
  ring.longest = __reduce_max_sync(0xffffffffU, ring.size);
  if (ring.size == 0) {
    return;
  }
  // One place more than the longest ring has: where it is closed.
  if (!is_long) {
    const std::int32_t origin = sizeof(Slot) == 2 ? v : 0;
    unrolled<capacity, smallest + 1>(
        ring.longest + 1, [&](auto i) { ring.neighbours[i] = points.load(origin + record.slot(i < slots ? i() : 0)); });
  } else {
    const std::int32_t* const neighbours = long_rings + record.long_begin();
    unrolled<capacity, smallest + 1>(
        ring.longest + 1, [&](auto i) { ring.neighbours[i] = points.load(__ldg(neighbours + (i < size ? i() : 0))); });
  }
}

}  // namespace trismooth::cuda

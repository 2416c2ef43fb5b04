// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// The positions of a ring of any size as an update reads them, straight from memory.
template <class T, class Ring>
struct RingInMemory {
  PointArray<T> points;
  Ring ring;
  std::int32_t count;

  __device__ int size() const { return count; }
  __device__ Point2<T> operator[](int i) const { return points.load(ring[i]); }
  __device__ std::int32_t number(int i) const { return ring[i]; }
  /// Of rings with quadrilaterals, which makes it a MixedRing.
  __device__ bool is_quadrilateral(int i) const requires MixedRing<Ring> { return ring.is_quadrilateral(i); }
};

/// for_elements_around() where there are quadrilaterals, which asks for each vertex once.
template <class T, MixedRing Ring, class NodeAt, class Visit>
__device__ __forceinline__ void for_elements_around(const RingInMemory<T, Ring>& ring, const NodeAt& node,
                                                    const Visit& visit) {
  using Node = decltype(node(0));
  const int size = ring.size();
  const Node first = node(0);
  Node next = first;
  // Not unrolled where the size is known: that takes more registers than there are.
#pragma unroll 1
  for (int i = 0; i < size; ++i) {
    const Node previous = i + 1 < size ? node(i + 1) : first;
    if (ring.is_quadrilateral(i)) {
      visit(QuadrilateralCorner<Node>{next, node(size + i), previous});
    } else {
      visit(TriangleCorner<Node>{next, previous});
    }
    next = previous;
  }
}

/// That of a vertex among rings of any kind.
template <class T, class Rings>
__device__ auto ring_in_memory(const PointArray<T>& points, const Rings& rings, std::int32_t v) {
  return RingInMemory<T, decltype(rings.ring(v))>{points, rings.ring(v), rings.ring_size(v)};
}

/// The numbers of a ring of four quadrilaterals that is in a record: a MixedRing.
template <class Slot>
struct RecordedFan {
  static constexpr int count = SlottedMixedRing<Slot>::quadrilaterals;

  std::int32_t first;
  const Slot* slots;

  __device__ RecordedFan(std::int32_t vertex, const RingRecord<Slot>& record)
      : first(sizeof(Slot) == 2 ? vertex : 0), slots(reinterpret_cast<const Slot*>(record.words)) {}

  static constexpr __device__ int size() { return count; }
  __device__ std::int32_t operator[](int i) const { return first + slots[i]; }
  static constexpr __device__ bool is_quadrilateral(int /*i*/) { return true; }
};

/// Answers body(ring) with the ring of a vertex in memory: a type of its own where it is of four quadrilaterals, as
/// most are where there are any.
template <class T, class Rings, class Body>
__device__ __forceinline__ auto with_ring_in_memory(const PointArray<T>& points, const Rings& rings, std::int32_t v,
                                                    const Body& body) {
  return body(ring_in_memory(points, rings, v));
}
template <class T, class Slot, class Body>
__device__ __forceinline__ auto with_ring_in_memory(const PointArray<T>& points,
                                                    const SlottedMixedRingsView<Slot>& rings, std::int32_t v,
                                                    const Body& body) {
  using Fan = RecordedFan<Slot>;
  const RingRecord<Slot>& record = rings.records[v];
  return record.is_long() ? body(ring_in_memory(points, rings, v))
                          : body(RingInMemory<T, Fan>{points, Fan(v, record), Fan::count});
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// The ring of a vertex of four quadrilaterals in registers, where loops over it are unrolled: a MixedRing.
template <class T>
struct QuadrilateralFan {
  static constexpr int count = SlottedMixedRing<std::int32_t>::quadrilaterals;

  Point2<T> points[2 * count];  ///< the neighbours, then the vertices opposite

  static constexpr TRISMOOTH_HOST_DEVICE int size() { return count; }
  TRISMOOTH_HOST_DEVICE Point2<T> operator[](int i) const { return points[i]; }
  static constexpr TRISMOOTH_HOST_DEVICE bool is_quadrilateral(int /*i*/) { return true; }
};

/// for_elements_around(), which asks for each neighbour once.
template <class T, class NodeAt, class Visit>
TRISMOOTH_HOST_DEVICE void for_elements_around(const QuadrilateralFan<T>& ring, const NodeAt& node,
                                               const Visit& visit) {
  using Node = decltype(node(0));
  const Node first = node(0);
  Node next = first;
#pragma unroll
  for (int i = 0; i < ring.count; ++i) {
    const Node previous = i + 1 < ring.count ? node(i + 1) : first;
    visit(QuadrilateralCorner<Node>{next, node(ring.count + i), previous});
    next = previous;
  }
}

/// Fetches the ring with this record into registers. False where it is another one.
template <class T, class Slot>
__device__ __forceinline__ bool fetch_ring(std::int32_t v, const RingRecord<Slot>& record,
                                           const std::int32_t* long_rings, const PointArray<T>& points,
                                           QuadrilateralFan<T>& ring) {
  constexpr int numbers_in_record = 2 * QuadrilateralFan<T>::count;
  std::int32_t numbers[numbers_in_record];
  bool is_fan = true;
  if (!record.is_long()) {
#pragma unroll
    for (int i = 0; i < numbers_in_record; ++i) {
      numbers[i] = (sizeof(Slot) == 2 ? v : 0) + record.slot(i);
    }
  } else {
    is_fan = record.long_size() == ring.count;
    const std::int32_t* const list = long_rings + (is_fan ? record.long_begin() : 0);
#pragma unroll
    for (int i = 0; i < numbers_in_record; ++i) {
      numbers[i] = __ldg(list + i);
      is_fan = is_fan && numbers[i] != no_corner;
    }
  }
  if (is_fan) {
#pragma unroll
    for (int i = 0; i < numbers_in_record; ++i) {
      ring.points[i] = points.load(numbers[i]);
    }
  }
  return is_fan;
}

}  // namespace trismooth::cuda

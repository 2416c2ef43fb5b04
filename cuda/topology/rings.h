// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// One-rings in device memory, for kernels. Vertices from `size` on have no ring: they are fixed.
struct RingsView {
  std::int32_t size;               ///< vertices with an entry in `offsets`
  const std::uint32_t* offsets;    ///< vertex v has neighbours[offsets[v] .. offsets[v + 1]); maybe none
  const std::int32_t* neighbours;  ///< in ring order

  TRISMOOTH_HOST_DEVICE std::int32_t ring_size(std::int32_t vertex) const {
    return static_cast<std::int32_t>(offsets[vertex + 1] - offsets[vertex]);
  }
  TRISMOOTH_HOST_DEVICE const std::int32_t* ring(std::int32_t vertex) const { return neighbours + offsets[vertex]; }
};

/// The numbers of a ring with quadrilaterals, in device memory: a MixedRing.
struct MixedRingInMemory {
  const std::int32_t* neighbours;
  const std::int32_t* opposites;  ///< one a neighbour, no_corner in a triangle
  std::int32_t count;

  TRISMOOTH_HOST_DEVICE int size() const { return count; }
  TRISMOOTH_HOST_DEVICE std::int32_t operator[](int i) const {
    return i < count ? neighbours[i] : opposites[i - count];
  }
  TRISMOOTH_HOST_DEVICE bool is_quadrilateral(int i) const { return opposites[i] != no_corner; }
};

/// RingsView of a mesh with quadrilaterals.
struct MixedRingsView : RingsView {
  const std::int32_t* opposites;  ///< as OneRings::opposites

  // NOLINTNEXTLINE(bugprone-derived-method-shadowing-base-method): templates ask for rings of either kind by one name.
  TRISMOOTH_HOST_DEVICE MixedRingInMemory ring(std::int32_t vertex) const {
    return {neighbours + offsets[vertex], opposites + offsets[vertex], ring_size(vertex)};
  }
};

/// Calls visit(number) for all other vertices of the elements around a vertex: once for each neighbour, and for each
/// quadrilateral. `ring`: the numbers of its ring, which has so many neighbours.
template <class Ring, class Visit>
TRISMOOTH_HOST_DEVICE void for_vertices_around(const Ring& ring, std::int32_t size, const Visit& visit) {
  for (std::int32_t i = 0; i < size; ++i) {
    visit(ring[i]);
  }
  if constexpr (MixedRing<Ring>) {
    for (std::int32_t i = 0; i < size; ++i) {
      if (ring.is_quadrilateral(i)) {
        visit(ring[size + i]);
      }
    }
  }
}

/// Owns them. 32-bit offsets reach for every mesh: three corners of at most 715827882 triangles, four of at most
/// 536870911 elements.
struct DeviceRings {
  DeviceBuffer<std::uint32_t> offsets;
  DeviceBuffer<std::int32_t> neighbours;
  DeviceBuffer<std::int32_t> opposites = {};  ///< as OneRings::opposites: empty where there are triangles alone

  bool has_quadrilaterals() const { return opposites.size() > 0; }
  std::int32_t size() const { return offsets.size() == 0 ? 0 : static_cast<std::int32_t>(offsets.size()) - 1; }
  RingsView view() const { return {size(), offsets.data(), neighbours.data()}; }
  MixedRingsView mixed_view() const { return {view(), opposites.data()}; }
};

}  // namespace trismooth::cuda

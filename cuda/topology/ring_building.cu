// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <utility>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/ring_building.h"
#include "trismooth/cuda/topology/vertex_fan.h"

namespace trismooth::cuda {

namespace {

struct MeasureRing {
  CornersView corners;
  const std::uint8_t* fixed;
  std::uint32_t* sizes;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t v) const { sizes[v] = fixed[v] == 0 ? corners.degree(v) : 0; }
};

struct BuildRing {
  TriangleList triangles;
  CornersView corners;
  const std::uint8_t* fixed;
  const std::uint8_t* reversed;
  const std::uint32_t* offsets;
  std::int32_t* neighbours;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t v) const {
    const std::uint32_t degree = corners.degree(v);
    if (fixed[v] != 0 || degree > VertexFan::capacity) {
      return;
    }
    const std::int32_t* const own = corners.at(v);
    const VertexFan fan(triangles, own, static_cast<int>(degree));
    fan.write_ring([&](int k) { return reversed[own[k] / 3] != 0; }, neighbours + offsets[v]);
  }
};

/// Where a slot of a large fan stands in its ring: `distance` slots after `slot`, which is the first one of the ring in
/// the end. Every slot doubles its distance in a round (J. C. Wyllie's list ranking).
struct RingPlace {
  std::uint32_t slot;
  std::uint32_t distance;
};

/// What a slot of a large fan is, seen counter-clockwise.
struct LargeCorner {
  bool is_free;  ///< of a vertex that has a ring
  std::uint32_t large_vertex;
  std::int32_t vertex;
  std::int32_t leading;          ///< the neighbour with which its triangle begins
  std::uint32_t leading_record;  ///< which says so
};

struct LargeRings {
  TriangleList triangles;
  CornersView corners;
  LargeFansView fans;
  const std::uint8_t* fixed;
  const std::uint8_t* reversed;

  TRISMOOTH_HOST_DEVICE LargeCorner at(std::uint32_t slot) const {
    const std::uint32_t i = fans.owner(slot);
    const std::int32_t vertex = fans.vertices[i];
    if (fixed[vertex] != 0) {
      return {false, i, vertex, 0, 0};
    }
    const std::int32_t corner = fans.corner(corners, i, slot);
    const int side = reversed[corner / 3] != 0 ? 1 : 0;
    return {true, i, vertex, triangles.neighbour(corner, side), 2 * slot + static_cast<std::uint32_t>(side)};
  }
};

/// Points each slot at the one before it, and the first one of a ring at itself.
struct StartRanking {
  LargeRings rings;
  RingPlace* places;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t slot) const {
    const LargeCorner corner = rings.at(slot);
    if (!corner.is_free || corner.leading == rings.fans.smallest[corner.large_vertex]) {
      places[slot] = {slot, 0};
    } else {
      places[slot] = {rings.fans.partners[corner.leading_record] / 2, 1};
    }
  }
};

struct DoubleDistances {
  const RingPlace* places;
  RingPlace* doubled;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t slot) const {
    const RingPlace near = places[slot];
    const RingPlace far = places[near.slot];
    doubled[slot] = {far.slot, near.distance + far.distance};
  }
};

struct WriteLargeRing {
  LargeRings rings;
  const RingPlace* places;
  const std::uint32_t* offsets;
  std::int32_t* neighbours;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t slot) const {
    const LargeCorner corner = rings.at(slot);
    if (corner.is_free) {
      neighbours[offsets[corner.vertex] + places[slot].distance] = corner.leading;
    }
  }
};

void build_large_rings(Context& context, const LargeRings& large, std::uint32_t largest_degree,
                       const std::uint32_t* offsets, std::int32_t* neighbours) {
  const std::uint32_t slots = large.fans.slots;
  DeviceBuffer<RingPlace> places(context, slots);
  DeviceBuffer<RingPlace> doubled(context, slots);
  for_each(context, slots, StartRanking{large, places.data()});
  for (std::uint64_t reach = 1; reach < largest_degree; reach *= 2) {
    for_each(context, slots, DoubleDistances{places.data(), doubled.data()});
    std::swap(places, doubled);
  }
  for_each(context, slots, WriteLargeRing{large, places.data(), offsets, neighbours});
}

}  // namespace

DeviceRings build_rings(Context& context, const TriangleList& triangles, const CornersView& corners,
                        const LargeFans& large_fans, const std::uint8_t* fixed, const std::uint8_t* reversed) {
  const auto vertex_count = static_cast<std::uint32_t>(corners.vertex_count);
  DeviceRings rings;
  rings.offsets = DeviceBuffer<std::uint32_t>(context, std::size_t{vertex_count} + 1);
  std::uint32_t* const offsets = rings.offsets.data();
  TRISMOOTH_CUDA_CHECK(cudaMemsetAsync(offsets, 0, sizeof(std::uint32_t), context.stream()));
  for_each(context, vertex_count, MeasureRing{corners, fixed, offsets + 1});
  sum_up(context, offsets, std::int64_t{vertex_count} + 1);
  rings.neighbours = DeviceBuffer<std::int32_t>(context, download(context, offsets + vertex_count));
  std::int32_t* const neighbours = rings.neighbours.data();
  for_each(context, vertex_count, BuildRing{triangles, corners, fixed, reversed, offsets, neighbours});
  if (large_fans.count > 0) {
    build_large_rings(context, {triangles, corners, large_fans.view(), fixed, reversed}, large_fans.largest_degree,
                      offsets, neighbours);
  }
  return rings;
}

}  // namespace trismooth::cuda

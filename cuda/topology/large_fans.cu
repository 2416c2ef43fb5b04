// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstddef>

#include "trismooth/base/hold.h"
#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/large_fans.h"
#include "trismooth/cuda/topology/vertex_fan.h"

namespace trismooth::cuda {

namespace {

/// Lists the large vertices, and their degrees for the offsets.
struct ListLargeVertices {
  CornersView corners;
  std::uint32_t* listed;  ///< so far
  std::int32_t* vertices;
  std::uint32_t* degrees;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t v) const {
    const std::uint32_t degree = corners.degree(v);
    if (degree > VertexFan::capacity) {
      const std::uint32_t i = fetch_add(listed, 1);
      vertices[i] = static_cast<std::int32_t>(v);
      degrees[i] = degree;
    }
  }
};

/// A record as it is sorted: by its large vertex, then by the neighbour.
TRISMOOTH_HOST_DEVICE std::uint64_t record_key(std::uint32_t large_vertex, std::int32_t neighbour) {
  return (std::uint64_t{large_vertex} << 32U) | static_cast<std::uint32_t>(neighbour);
}
TRISMOOTH_HOST_DEVICE std::uint32_t large_vertex_of(std::uint64_t key) {
  return static_cast<std::uint32_t>(key >> 32U);
}
TRISMOOTH_HOST_DEVICE std::int32_t neighbour_of(std::uint64_t key) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(key));
}

/// One thread a slot. Makes each corner a fan of its own, too.
struct WriteRecords {
  TriangleList triangles;
  CornersView corners;
  LargeFansView fans;
  ParityForest slot_forest;
  std::uint64_t* keys;
  std::uint32_t* records;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t slot) const {
    const std::uint32_t i = fans.owner(slot);
    const std::int32_t corner = fans.corner(corners, i, slot);
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::size_t record = 2 * static_cast<std::size_t>(slot) + side;
      keys[record] = record_key(i, triangles.neighbour(corner, static_cast<int>(side)));
      records[record] = static_cast<std::uint32_t>(record);
    }
    slot_forest.plant(slot);
  }
};

/// One thread a record, in sorted order: those of one edge are next to each other.
struct PairRecords {
  TriangleList triangles;
  CornersView corners;
  LargeFansView fans;
  const std::int32_t* regions;
  ParityForest forest;
  ParityForest slot_forest;
  const std::uint64_t* keys;
  const std::uint32_t* records;
  std::uint32_t record_count;
  std::uint32_t* partners;
  std::uint32_t* reasons;  ///< of each large vertex
  std::uint32_t* joined;   ///< of each large vertex: corners that are not the first of their fan
  Findings* findings;

  TRISMOOTH_HOST_DEVICE bool same_edge(std::uint32_t i, std::uint32_t j) const {
    return j < record_count && keys[i] == keys[j];
  }

  /// The neighbour of the large vertex that the record's triangle has beside the record's own.
  TRISMOOTH_HOST_DEVICE std::int32_t other_neighbour(std::uint64_t key, std::uint32_t record) const {
    const std::int32_t corner = fans.corner(corners, large_vertex_of(key), record / 2);
    return triangles.neighbour(corner, static_cast<int>(1 - record % 2));
  }

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t i) const {
    const std::uint64_t key = keys[i];
    const std::uint32_t record = records[i];
    std::uint32_t* const own_reasons = &reasons[large_vertex_of(key)];
    // Below 0 the index wraps around to one that is too large.
    const bool before = same_edge(i, i - 1);
    const bool after = same_edge(i, i + 1);
    if (!before && !after) {
      partners[record] = LargeFansView::none;
      set_bits(own_reasons, hold::boundary);
      return;
    }
    const std::uint32_t partner = records[before ? i - 1 : i + 1];
    if ((before && after) || (before && same_edge(i, i - 2)) || (after && same_edge(i, i + 2)) ||
        other_neighbour(key, record) == other_neighbour(key, partner)) {
      partners[record] = LargeFansView::many;
      set_bits(own_reasons, hold::non_manifold);
      return;
    }
    partners[record] = partner;
    if (after) {
      pair(key, record, partner, own_reasons);
    }
  }

  TRISMOOTH_HOST_DEVICE void pair(std::uint64_t key, std::uint32_t record, std::uint32_t partner,
                                  std::uint32_t* own_reasons) const {
    const std::uint32_t i = large_vertex_of(key);
    const std::int32_t a = fans.corner(corners, i, record / 2) / 3;
    const std::int32_t b = fans.corner(corners, i, partner / 2) / 3;
    if (regions != nullptr && regions[a] != regions[b]) {
      set_bits(own_reasons, hold::interface);
    }
    if (fans.vertices[i] < neighbour_of(key)) {
      const std::uint32_t against = record % 2 == partner % 2 ? 1 : 0;
      if (forest.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), against) ==
          ParityForest::Join::contradicted) {
        set_bits(&findings->faults, Findings::one_sided);
      }
    }
    if (slot_forest.join(record / 2, partner / 2, 0) == ParityForest::Join::joined) {
      fetch_add(&joined[i], 1);
    }
  }
};

/// One thread a large vertex.
struct HoldLargeVertices {
  LargeFansView fans;
  const std::uint64_t* keys;
  const std::uint32_t* reasons;
  const std::uint32_t* joined;
  std::int32_t* smallest;
  std::uint8_t* fixed;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t i) const {
    const std::uint32_t degree = fans.offsets[i + 1] - fans.offsets[i];
    const std::uint32_t bow_tie = degree - joined[i] == 1 ? 0 : hold::bow_tie;
    fixed[fans.vertices[i]] |= static_cast<std::uint8_t>(reasons[i] | bow_tie);
    // Its records were sorted by their neighbours.
    smallest[i] = neighbour_of(keys[2 * static_cast<std::size_t>(fans.offsets[i])]);
  }
};

}  // namespace

LargeFans find_large_fans(Context& context, const TriangleList& triangles, const CornersView& corners,
                          const Findings& findings, const std::int32_t* regions, const ParityForest& forest,
                          std::uint8_t* fixed, Findings* device_findings) {
  LargeFans fans;
  fans.count = findings.large_vertices;
  fans.largest_degree = findings.largest_degree;
  if (fans.count == 0) {
    return fans;
  }
  fans.vertices = DeviceBuffer<std::int32_t>(context, fans.count);
  fans.offsets = DeviceBuffer<std::uint32_t>(context, std::size_t{fans.count} + 1);
  fans.offsets.fill_bytes(0);
  {
    DeviceBuffer<std::uint32_t> listed(context, 1);
    listed.fill_bytes(0);
    for_each(context, static_cast<std::uint32_t>(corners.vertex_count),
             ListLargeVertices{corners, listed.data(), fans.vertices.data(), fans.offsets.data() + 1});
  }
  sum_up(context, fans.offsets.data(), std::int64_t{fans.count} + 1);
  fans.slots = download(context, fans.offsets.data() + fans.count);
  const std::size_t record_count = 2 * std::size_t{fans.slots};
  fans.partners = DeviceBuffer<std::uint32_t>(context, record_count);
  fans.smallest = DeviceBuffer<std::int32_t>(context, fans.count);

  DeviceBuffer<std::uint64_t> keys(context, record_count);
  DeviceBuffer<std::uint32_t> records(context, record_count);
  DeviceBuffer<std::uint32_t> slot_words(context, fans.slots);
  DeviceBuffer<std::uint32_t> reasons(context, fans.count);
  DeviceBuffer<std::uint32_t> joined(context, fans.count);
  reasons.fill_bytes(0);
  joined.fill_bytes(0);
  const ParityForest slot_forest{slot_words.data()};
  for_each(context, fans.slots,
           WriteRecords{triangles, corners, fans.view(), slot_forest, keys.data(), records.data()});
  sort_by_key(context, keys, records, 32 + static_cast<int>(std::bit_width(fans.count - 1)));
  for_each(context, static_cast<std::uint32_t>(record_count),
           PairRecords{triangles, corners, fans.view(), regions, forest, slot_forest, keys.data(), records.data(),
                       static_cast<std::uint32_t>(record_count), fans.partners.data(), reasons.data(), joined.data(),
                       device_findings});
  for_each(context, fans.count,
           HoldLargeVertices{fans.view(), keys.data(), reasons.data(), joined.data(), fans.smallest.data(), fixed});
  return fans;
}

}  // namespace trismooth::cuda

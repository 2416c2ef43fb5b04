// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/parity_forest.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/findings.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// The fans of large vertices, those of more than VertexFan::capacity triangles, for as many threads as they have
/// corners: a hub may be in every triangle of the mesh. The corners of all of them stand in one row of slots, vertex by
/// vertex. Record 2 s + side is a neighbour as in VertexFan, of slot s.
struct LargeFansView {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;  ///< see FanPairs
  static constexpr std::uint32_t many = 0xFFFFFFFEU;

  std::uint32_t count;            ///< large vertices
  std::uint32_t slots;            ///< their corners
  const std::int32_t* vertices;   ///< in no order
  const std::uint32_t* offsets;   ///< large vertex i has slots offsets[i] .. offsets[i + 1]
  const std::uint32_t* partners;  ///< of each record: the other one of its neighbour, none, or many
  const std::int32_t* smallest;   ///< of each large vertex: its smallest neighbour

  /// The large vertex of a slot.
  TRISMOOTH_HOST_DEVICE std::uint32_t owner(std::uint32_t slot) const {
    std::uint32_t begin = 0;
    std::uint32_t end = count;
    while (end - begin > 1) {
      const std::uint32_t middle = begin + (end - begin) / 2;
      (offsets[middle] <= slot ? begin : end) = middle;
    }
    return begin;
  }
  /// The corner of a slot of large vertex i.
  TRISMOOTH_HOST_DEVICE std::int32_t corner(const CornersView& corners, std::uint32_t i, std::uint32_t slot) const {
    return corners.at(static_cast<std::uint32_t>(vertices[i]))[slot - offsets[i]];
  }
};

/// Owns them. Empty where there is no large vertex.
struct LargeFans {
  std::uint32_t count = 0;
  std::uint32_t slots = 0;
  std::uint32_t largest_degree = 0;
  DeviceBuffer<std::int32_t> vertices;
  DeviceBuffer<std::uint32_t> offsets;
  DeviceBuffer<std::uint32_t> partners;
  DeviceBuffer<std::int32_t> smallest;

  LargeFansView view() const {
    return {count, slots, vertices.data(), offsets.data(), partners.data(), smallest.data()};
  }
};

/// Finds the large fans (`findings` says how many there are), and does for their vertices what determine_constraints()
/// does for the others: adds to the bits of `fixed`, joins the triangles of edges in `forest`, and reports one-sided
/// surfaces. `regions` may be null. Complexity: a sort of the records. Memory: 48 bytes for each corner of a large
/// vertex, for a while; 8 are kept.
LargeFans find_large_fans(Context& context, const TriangleList& triangles, const CornersView& corners,
                          const Findings& findings, const std::int32_t* regions, const ParityForest& forest,
                          std::uint8_t* fixed, Findings* device_findings);

}  // namespace trismooth::cuda

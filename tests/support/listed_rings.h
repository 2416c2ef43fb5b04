// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/smoothing/rings/listed_rings.h"
#include "trismooth/smoothing/rings/vertex_rim.h"

#include "catch.h"

/// Rings as they are listed, beside those of matched sides.
namespace listed_rings {

/// Whether a mesh is one whose rings can be told as its triangles are listed: by what the matching of its sides says.
inline bool is_alike_in_fans(const trismooth::TriangleTopology& topology) {
  return std::ranges::none_of(topology.hold,
                              [](std::uint8_t bits) {
                                return (bits & ~(trismooth::hold::boundary | trismooth::hold::isolated)) != 0;
                              }) &&
         std::ranges::count(topology.parity, 0) == std::ssize(topology.parity) &&
         std::ranges::all_of(topology.degree,
                             [](std::int32_t degree) { return degree <= static_cast<int>(trismooth::most_rim_edges); });
}

inline bool same(const trismooth::OneRings& a, const trismooth::OneRings& b) {
  return a.offsets == b.offsets && a.neighbours == b.neighbours;
}

/// Requires that the rings and the sides of a mesh, as they are listed, or that they cannot be told so, are those of
/// its matched sides. Whether they can.
inline bool require_those_of_matched_sides(std::int32_t vertex_count, const std::vector<trismooth::Triangle>& triangles,
                                           int threads) {
  trismooth::Workers workers(threads);
  const trismooth::TriangleTopology topology = trismooth::connect_triangles(vertex_count, triangles, workers);
  const std::optional<trismooth::ListedRings> listed = trismooth::find_listed_rings(vertex_count, triangles, workers);
  REQUIRE(listed.has_value() == is_alike_in_fans(topology));
  if (listed) {
    REQUIRE(listed->hold == topology.hold);
    REQUIRE(listed->components.alike);
    REQUIRE(listed->components.components == topology.components);
    REQUIRE(listed->components.component == topology.component);
    REQUIRE(listed->components.parity == topology.parity);
    REQUIRE(same(listed->rings, trismooth::one_rings(topology, triangles, topology.parity, topology.hold, workers)));
  }
  const std::optional<trismooth::TriangleTopology> sides =
      trismooth::find_listed_topology(vertex_count, triangles, workers);
  REQUIRE(sides.has_value() == listed.has_value());
  if (sides) {
    REQUIRE(sides->vertex_count == topology.vertex_count);
    REQUIRE(sides->twins == topology.twins);
    REQUIRE(sides->corner == topology.corner);
    REQUIRE(sides->degree == topology.degree);
    REQUIRE(sides->hold == topology.hold);
    REQUIRE(sides->alike);
    REQUIRE(sides->components == topology.components);
    REQUIRE(sides->component == topology.component);
    REQUIRE(sides->parity == topology.parity);
  }
  return listed.has_value();
}

}  // namespace listed_rings

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;

/// Components of a mesh that are turned over: what is counter-clockwise in them is not what it was in the input.
struct TurnedComponents {
  std::int32_t count = 0;
  std::vector<std::uint8_t> elements{};  ///< one byte an element, 1 where it is of such a component; empty: none is

  bool any() const { return count > 0; }
};

/// `reversed` (as MeshRings::reversed) where those components have been turned over.
std::vector<std::uint8_t> turned_over(std::span<const std::uint8_t> reversed, const TurnedComponents& turned);

/// Rings of which some are turned over.
struct TurnedRings {
  BulkVector<std::int32_t> neighbours;
  BulkVector<std::int32_t> opposites;  ///< as OneRings::opposites

  /// Those of `rings`, turned over.
  RingView of(const RingView& rings) const { return {rings.offsets, neighbours, rings.input_index, opposites}; }
};

/// `rings` where those components have been turned over: clockwise is counter-clockwise there, and the neighbour that
/// is first stays so. `elements`: of the mesh, in the input's numbering.
TurnedRings turned_rings(const RingView& rings, const ElementList& elements, const TurnedComponents& turned);

/// inverted_elements() where those components of the input have been turned over.
std::int64_t inverted_elements(const RingView& rings, const ElementList& elements, const TurnedComponents& turned,
                               std::span<const Point2<double>> points, Workers& workers);

/// What untangle_mesh() did.
struct MeshUntangling {
  std::int64_t inverted_before = 0;  ///< as UntangleOutcome, in the orientation that the input has
  std::int64_t inverted_after =
      0;  ///< as UntangleOutcome, where components have been turned over in the one that they have now
  TurnedComponents turned;
};

/// untangle(), and what it cannot know: in a mesh that is tangled through and through, half of the elements are
/// inverted, and so the majority that orients a component may be the wrong one. Where a component's elements have a
/// negative area in all, which no position of its free vertices changes, it is turned over and untangled afresh. That
/// is kept where it leaves fewer inverted elements, and nothing is worse than in the input (keep_never_worse() below).
///
/// `rings`, `points`: as untangle() has them, the rings as the input is oriented. `elements` and `reversed` (as
/// MeshRings::reversed): of the mesh, in the input's numbering.
MeshUntangling untangle_mesh(const RingView& rings, const ElementList& elements, std::span<const std::uint8_t> reversed,
                             std::span<Point2<double>> points, Workers& workers);

/// The never-worse guard of a mesh in which components have been turned over. Each of these is judged by itself: its
/// elements as the input orients them before, and as they are turned now. If one of them offends, or most of them are
/// inverted, all vertices of the component go back, and it is taken out of `turned`. The rest of the mesh is judged as
/// by keep_never_worse() in guard/never_worse.h. `rings`: however they are turned. `nodes`: those that follow the
/// vertices, of rings in the input's numbering; null: none do. Complexity: that of keep_never_worse(), and where there
/// are turned components that of matching the mesh's sides.
GuardOutcome keep_never_worse(const RingView& rings, const ElementList& elements,
                              std::span<const std::uint8_t> reversed, TurnedComponents& turned,
                              std::span<const Point2<double>> before, std::span<Point2<double>> after, Workers& workers,
                              FollowingNodes* nodes = nullptr);

}  // namespace trismooth

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/untangle/untangle.h"

namespace trismooth {

class Workers;

/// What untangle_mesh() did.
struct MeshUntangling {
  UntangleOutcome outcome;
  std::int32_t turned_components = 0;
  /// Where a component was turned over: per vertex of the rings, 1 where its ring must be so, too (turn_rings()).
  std::vector<std::uint8_t> turned;
  std::vector<std::uint8_t> reversed;  ///< likewise: what the mesh's flags are now
};

/// untangle(), and what it cannot know: in a mesh that is tangled through and through, half of the triangles are
/// inverted, and so the majority that orients a component may be the wrong one. Where a component's triangles have a
/// negative area in all, which no position of its free vertices changes, it is turned over first. That is kept where it
/// leaves fewer inverted triangles, and the majority is for it afterwards.
///
/// `rings`, `points`: as untangle() has them. `triangles` and `reversed` (as MeshRings::reversed): of the mesh, in the
/// input's numbering.
MeshUntangling untangle_mesh(const RingView& rings, std::span<const Triangle> triangles,
                             std::span<const std::uint8_t> reversed, std::span<Point2<double>> points,
                             Workers& workers);

/// Turns rings over: clockwise becomes counter-clockwise, and the neighbour that is first stays so.
void turn_rings(std::span<const std::int64_t> offsets, std::span<const std::uint8_t> turned,
                std::span<std::int32_t> neighbours);

}  // namespace trismooth

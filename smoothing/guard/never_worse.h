// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/number_lists.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/guard/guard_rule.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Halo;
class Workers;

/// Nodes beside the corners of elements, in the middle of sides or of quadrilaterals: they go with the corners, and an
/// element that they spoil offends, however good that of its corners is.
class FollowingNodes {
 public:
  FollowingNodes() = default;
  FollowingNodes(const FollowingNodes&) = delete;
  FollowingNodes& operator=(const FollowingNodes&) = delete;
  virtual ~FollowingNodes() = default;

  /// The corner has gone back: the nodes that it is a reason for go along.
  virtual void follow(std::int32_t corner) = 0;
  /// Whether the element with these corners, in any order, is less valid than it was. `is_turned`: it is turned over
  /// now. From any thread.
  virtual bool is_spoiled(std::span<const std::int32_t> corners, bool is_turned) const = 0;
};

/// What the guard took back.
struct GuardOutcome {
  std::vector<std::int32_t> reverted;  ///< vertices, ascending
  std::int64_t rounds = 0;             ///< rounds that took something back
  /// T in the end; infinity where nothing is elsewhere.
  double threshold = std::numeric_limits<double>::infinity();
};

/// The never-worse guard. `before` and `after` are the coordinates as they were stored and as they would be, both in
/// the local frame, one for every vertex. In rounds: let T be the smallest quality before among the elements of the
/// vertices that are elsewhere now; all moved vertices of all elements that offend (see offends) go back to where they
/// were, at once; until none offends. Afterwards no element that was valid is invalid, and none is both worse than it
/// was and worse than the worst element around the vertices that stay moved was. T is one number for the whole mesh; it
/// is found again in every round, for it rises when the vertices around that element have gone back. Elements are
/// evaluated in float64 in canonical corner order (smallest input index first), so each gives the same bits from every
/// vertex, in the report too. Ends: each round returns a vertex. Complexity: one pass over the elements of free
/// vertices; a round costs what it takes back (times log n), not the mesh.
///
/// `held`: of vertices that may have moved without having a ring. They are judged as corners of the elements of others,
/// and go back as these do.
///
/// `halo`: of a part of a mesh; null: it is the whole. The parts make the rounds together. `held` are those of its
/// ghosts then, and what went back are vertices of the part.
///
/// `nodes`: those that follow the vertices; null: none do.
GuardOutcome keep_never_worse(const RingView& rings, std::span<const Point2<double>> before,
                              std::span<Point2<double>> after, Workers& workers, const NumberLists& held = {},
                              Halo* halo = nullptr, FollowingNodes* nodes = nullptr);

/// Sorts by vertex what several guards took back, and counts it. Who went back more than once is named once, with where
/// the first found it; who is there again, at `points`, is not.
void name_reverted(SmoothingResult& result, std::span<const Point2<double>> points);

}  // namespace trismooth

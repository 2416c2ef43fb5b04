// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// What keep_never_worse() let stand, and what it took back.
struct KeptMoves {
  std::int64_t moved_vertices = 0;       ///< whose coordinates differ from those before, in the end
  std::vector<std::int32_t> held;        ///< that had been moved and are held fixed: they are back. Ascending
  std::vector<RevertedVertex> reverted;  ///< that are back since elements got worse, ascending by vertex
  std::int64_t rounds = 0;               ///< that took vertices back
  std::int64_t inverted = 0;             ///< elements that are inverted in the end, each as its component is oriented
  std::int64_t degenerate = 0;           ///< elements without area, or with a flat corner, in the end
};

/// The never-worse guard of smooth(), for vertices that something else has moved: an optimiser, a user, another tool.
/// `before` has the points as they were, `after` where they are now: one for every vertex each, of the same type of
/// number; `triangles` and `constraints` are those of smooth(), and so are the vertices that are held, but for those
/// that smooth() keeps for a layer. Vertices go back to where they were, in place, their numbers bit by bit, until this
/// holds: what is held has not moved; no element that was valid is inverted or degenerate; and none is both worse than
/// it was and worse than the worst element around the moved vertices was. Worse is a smaller shape
/// (quality/triangle_quality.h, quality/quadrilateral_quality.h). What smooth() gives passes as it is. What has gone
/// 2^100 times the mesh's extent out of it goes back in any case.
///
/// The caller owns all arrays; `after` alone is written, and only when nothing can be thrown any more. With three
/// numbers a point the third one is its height, as in smooth(), and the same before and after. `threads`: 0 is one for
/// each core; the result does not depend on it. Throws MeshError for triangles that are no mesh, for coordinates that
/// are not finite and for heights that differ, or have changed; std::invalid_argument for numbers of points that
/// differ, types that differ, constraints that do not fit, or where vertices are to slide. Complexity: linear, and what
/// goes back times its logarithm in each round.
KeptMoves keep_never_worse(const ConstPointView& before, const PointView& after, const IndexView& triangles,
                           const Constraints& constraints = {}, int threads = 0);

/// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
template <class Before, array_layout::OtherPoints R>
KeptMoves keep_never_worse(Before&& /*before*/, R&& /*after*/, const IndexView& /*triangles*/,
                           const Constraints& /*constraints*/ = {}, int /*threads*/ = 0) {
  array_layout::refuse_points<R>();
  return {};
}

}  // namespace trismooth

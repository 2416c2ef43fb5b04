// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth {

/// Where the vertices of a Slidable are.
struct SlideMesh {
  std::span<const Point2<double>> points;  ///< of its vertices, in the local frame
  std::span<const double> roundings;  ///< how far rounding may have brought each point from where it was meant to be
};

/// Whether a line is straight at `vertex` between its neighbours, to rounding. All points that are straight to it may
/// be `rounding` off.
bool is_straight(Point2<double> before, Point2<double> vertex, Point2<double> after, double rounding);

/// A run of vertices along a line, the ends of an open one included. Numbers are those of the Slidable.
struct ChainRun {
  std::vector<std::int32_t> vertices;
  bool is_closed = false;

  /// Places of the vertices that slide.
  std::size_t begin() const { return is_closed ? 0 : 1; }
  std::size_t end() const { return is_closed ? vertices.size() : vertices.size() - 1; }
};

/// Runs that slide as one: the first one, and others that are linked with it vertex by vertex, turned as it is.
struct LinkedRuns {
  ChainRun first;
  std::vector<ChainRun> others;
};

/// Vertices that would slide and are held where lines touch: see TouchingLines.
struct HeldTouching {
  std::int64_t in_same_place = 0;
  std::int64_t at_edges = 0;
};

struct ChainRuns {
  std::vector<LinkedRuns> runs;        ///< in the order of their smallest vertex that slides
  std::vector<std::uint8_t> slides{};  ///< one flag a vertex of the Slidable
  HeldTouching held{};
};

/// Finds where the vertices of a mesh slide: runs end at corners, at vertices that may not slide, where lines touch
/// (see find_touching_lines()) or that are linked with what does not slide. Complexity: n log n in the vertices that
/// are held.
ChainRuns find_chain_runs(const Slidable& slidable, const SlideMesh& mesh);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth {

/// Where lines of a Slidable touch each other without sharing vertices. All numbers are those of the Slidable.
struct TouchingLines {
  /// Vertices that lie in the same place, each with another that does: as those of one place are linked through.
  std::vector<std::array<std::int32_t, 2>> together;
  /// One flag a vertex: it lies within an edge of a line, not at the ends, or is an end of such an edge.
  std::vector<std::uint8_t> at_edges;
};

/// Finds them among the vertices that are held. What is nearly so counts as well: within a thousandth of the shortest
/// edge of lines at the vertices (and at the ends of the edge), and a tenth of their height in any element, so that
/// two sides of a thin layer do not touch. `points`: of the vertices. Complexity: n log n in the vertices, and linear
/// in their number times the binary orders of magnitude of the lengths of edges; an edge that is much longer than those
/// beside it takes as long as there are vertices beside it.
TouchingLines find_touching_lines(const Slidable& slidable, std::span<const Point2<double>> points);

}  // namespace trismooth

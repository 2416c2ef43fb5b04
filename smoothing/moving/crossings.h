// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// Two edges that have a point in common.
struct MeetingEdges {
  std::int32_t one;  ///< the smaller number
  std::int32_t other;
  bool cross;  ///< each goes from one side of the other to the other side; else they touch

  auto operator<=>(const MeetingEdges&) const = default;
};

/// The pairs of edges that cross or touch each other, to rounding, ascending. Edges that share a vertex do where one
/// lies on the other. `points`: in a frame in which a mesh is about 1 wide. `most`: no more pairs are looked for than
/// so many. Complexity: that of sorting the edges, and linear in the pairs whose boxes overlap.
std::vector<MeetingEdges> meeting_edges(std::span<const std::array<std::int32_t, 2>> edges,
                                        std::span<const Point2<double>> points, std::size_t most);

}  // namespace trismooth

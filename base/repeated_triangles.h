#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

class Workers;

/// A triangle that is listed again.
struct RepeatedTriangle {
  std::int32_t triangle;  ///< its number
  std::int32_t first;  ///< that of the lowest triangle with the same three corners, which is none that is listed again

  bool operator==(const RepeatedTriangle&) const = default;
};

/// The triangles that have the three corners of one before them, in whatever order; ascending. Programs list triangles
/// again for every group that has them. What smooths takes each for a triangle of its own: two copies look like
/// neighbours of each other, so that a corner of the boundary may look like a vertex inside, and one of them like an
/// inverted triangle. So leave the copies out before.
///
/// Corners are below `vertex_count`. Complexity: linear, and n log n in the triangles that are there more than once;
/// allocates 16 bytes for each vertex, for a while.
std::vector<RepeatedTriangle> find_repeated_triangles(std::span<const Triangle> triangles, std::size_t vertex_count,
                                                      Workers& workers);

}  // namespace trismooth

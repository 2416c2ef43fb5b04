// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving/overlaps.h"

#include <atomic>
#include <cstddef>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/moving/winding.h"

namespace trismooth {

std::vector<std::int32_t> overlapping_vertices(std::span<const Triangle> triangles,
                                               std::span<const std::uint8_t> reversed,
                                               std::span<const std::uint8_t> held,
                                               std::span<const Point2<double>> points, Workers& workers) {
  std::vector<std::int64_t> around(points.size(), 0);
  workers.for_blocks(std::ssize(triangles), 8192, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t v = corners[i];
        const Point2<double> from = points[corners[(i + 1) % 3]] - points[v];
        const Point2<double> to = points[corners[(i + 2) % 3]] - points[v];
        if (const std::int64_t part = Winding::of(held[v] != 0, from, to); part != 0) {
          std::atomic_ref(around[v]).fetch_add(part, std::memory_order_relaxed);
        }
      }
    }
  });
  std::vector<std::int32_t> overlapping;
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (Winding::is_over(held[v] != 0, around[v])) {
      overlapping.push_back(static_cast<std::int32_t>(v));
    }
  }
  return overlapping;
}

}  // namespace trismooth

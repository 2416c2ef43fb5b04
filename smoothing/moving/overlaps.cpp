// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving/overlaps.h"

#include <atomic>
#include <cstddef>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/moving/winding.h"

namespace trismooth {

std::vector<std::int32_t> overlapping_vertices(const ElementList& elements, std::span<const std::uint8_t> reversed,
                                               std::span<const std::uint8_t> held,
                                               std::span<const Point2<double>> points, Workers& workers) {
  std::vector<std::int64_t> around(points.size(), 0);
  workers.for_blocks(static_cast<std::int64_t>(elements.size()), 8192, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const auto corners = elements[static_cast<std::size_t>(e)];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t v = corners[i];
        Point2<double> from = points[next_corner(corners, i)] - points[v];
        Point2<double> to = points[previous_corner(corners, i)] - points[v];
        if (reversed[e] != 0) {
          std::swap(from, to);
        }
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

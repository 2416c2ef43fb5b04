// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// The points of a mesh in its local frame. Found once for the coordinates of a run, and handed to all who need it.
struct LocalPoints {
  LocalFrame frame;
  BulkVector<Point2<double>> points;
};

/// The points within `frame`. Complexity: linear.
inline LocalPoints entered(const LocalFrame& frame, std::span<const Point2<double>> stored) {
  LocalPoints local{frame, BulkVector<Point2<double>>(stored.size())};
  std::ranges::transform(stored, local.points.begin(), [&](Point2<double> p) { return frame.enter(p); });
  return local;
}

/// The frame of the vertices that cells use, told by why each vertex is held (bits of namespace hold). Complexity:
/// linear.
inline LocalFrame local_frame_of_cells(std::span<const Point2<double>> stored, std::span<const std::uint8_t> held) {
  return local_frame(stored, [held](std::size_t v) { return !hold::is_unused(held[v]); });
}

/// The points in the frame of those for whose numbers `counts(std::size_t)` is true, found on all workers. Complexity:
/// linear.
template <class Counts>
LocalPoints local_points(std::span<const Point2<double>> stored, const Counts& counts, Workers& workers) {
  constexpr std::int64_t grain = 16384;
  const Box box = joined_blocks(
      std::ssize(stored), grain, workers, Box{},
      [&](std::int64_t begin, std::int64_t end, Box& found) {
        for (std::int64_t v = begin; v < end; ++v) {
          if (counts(static_cast<std::size_t>(v))) {
            found.add(stored[v]);
          }
        }
      },
      [](Box& all, const Box& found) { all.add(found); });
  LocalPoints local{local_frame(box.low, box.high), BulkVector<Point2<double>>(stored.size())};
  workers.for_blocks(std::ssize(stored), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      local.points[v] = local.frame.enter(stored[v]);
    }
  });
  return local;
}

}  // namespace trismooth

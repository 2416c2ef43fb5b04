#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/blocks.h"
#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/workers.h"

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
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Blocks blocks(std::ssize(stored), grain, workers);
  struct Box {
    Point2<double> low{infinity, infinity};
    Point2<double> high{-infinity, -infinity};

    void add(Point2<double> other_low, Point2<double> other_high) {
      low = {std::min(low.x, other_low.x), std::min(low.y, other_low.y)};
      high = {std::max(high.x, other_high.x), std::max(high.y, other_high.y)};
    }
  };
  std::vector<Box> boxes(static_cast<std::size_t>(blocks.count()));
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Box box;
    for (std::int64_t v = begin; v < end; ++v) {
      if (counts(static_cast<std::size_t>(v))) {
        box.add(stored[v], stored[v]);
      }
    }
    boxes[block] = box;
  });
  Box all;
  for (const Box& box : boxes) {
    all.add(box.low, box.high);
  }
  LocalPoints local{local_frame(all.low, all.high), BulkVector<Point2<double>>(stored.size())};
  workers.for_blocks(std::ssize(stored), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      local.points[v] = local.frame.enter(stored[v]);
    }
  });
  return local;
}

}  // namespace trismooth

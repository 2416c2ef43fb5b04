#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// The points of a mesh in its local frame. Found once for the coordinates of a run, and handed to all who need it.
struct LocalPoints {
  LocalFrame frame;
  std::vector<Point2<double>> points;
};

/// The points within `frame`. Complexity: linear.
inline LocalPoints entered(const LocalFrame& frame, std::span<const Point2<double>> stored) {
  LocalPoints local{frame, std::vector<Point2<double>>(stored.size())};
  std::ranges::transform(stored, local.points.begin(), [&](Point2<double> p) { return frame.enter(p); });
  return local;
}

/// The frame of the vertices that cells use, told by why each vertex is held (bits of namespace hold). Complexity:
/// linear.
inline LocalFrame local_frame_of_cells(std::span<const Point2<double>> stored, std::span<const std::uint8_t> held) {
  return local_frame(stored, [held](std::size_t v) { return !hold::is_unused(held[v]); });
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/shared_frame.h"

#include <algorithm>
#include <limits>

#include "trismooth/base/hold.h"

namespace trismooth::mpi {

LocalFrame shared_frame(std::span<const Point2<double>> points, std::span<const std::uint8_t> held,
                        const Communicator& ranks) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PartSums low;
  PartSums high;
  low.largest = high.largest = {-infinity, -infinity};
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!hold::is_unused(held[v])) {
      low.largest = {std::max(low.largest[0], -points[v].x), std::max(low.largest[1], -points[v].y)};
      high.largest = {std::max(high.largest[0], points[v].x), std::max(high.largest[1], points[v].y)};
    }
  }
  low = ranks.joined(low);
  high = ranks.joined(high);
  return local_frame({-low.largest[0], -low.largest[1]}, {high.largest[0], high.largest[1]});
}

}  // namespace trismooth::mpi

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"

namespace trismooth {

/// The positions and numbers of a ring, in memory that somebody else owns.
template <class T>
struct GatheredRing {
  std::span<const Point2<T>> positions;
  const std::int32_t* numbers;

  int size() const { return static_cast<int>(positions.size()); }
  Point2<T> operator[](int i) const { return positions[i]; }
  std::int32_t number(int i) const { return numbers[i]; }
};

/// Fetches the positions of a ring once, for all the passes of an update over it.
template <class T>
class RingGatherer {
 public:
  /// The positions points[ring[0]], points[ring[1]], ... They last until the next call.
  GatheredRing<T> gather(std::span<const Point2<T>> points, std::span<const std::int32_t> ring) {
    buffer_.resize(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      buffer_[i] = points[ring[i]];
    }
    return {buffer_, ring.data()};
  }

 private:
  std::vector<Point2<T>> buffer_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/one_rings.h"

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

/// Those of a ring with quadrilaterals: a MixedRing. Opposite vertices are behind the neighbours.
template <class T>
struct GatheredMixedRing {
  std::span<const Point2<T>> positions;
  MixedRingNumbers numbers;

  int size() const { return numbers.size(); }
  Point2<T> operator[](int i) const { return positions[i]; }
  std::int32_t number(int i) const { return numbers[i]; }
  bool is_quadrilateral(int i) const { return numbers.is_quadrilateral(i); }
};

/// Fetches the positions of a ring once, for all the passes of an update over it.
template <class T>
class RingGatherer {
 public:
  /// What visit(ring) returns for the ring of a vertex of the view: it is called with one of the types above, the first
  /// where the mesh has triangles alone.
  template <class Visit>
  auto visit(std::span<const Point2<T>> points, const RingView& rings, std::int32_t vertex, const Visit& visit) {
    return rings.has_quadrilaterals() ? visit(gather(points, rings.mixed(vertex)))
                                      : visit(gather(points, rings[vertex]));
  }

  GatheredMixedRing<T> gather(std::span<const Point2<T>> points, const MixedRingNumbers& ring) {
    const int size = ring.size();
    buffer_.resize(2 * static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) {
      buffer_[i] = points[ring[i]];
      buffer_[size + i] = ring.is_quadrilateral(i) ? points[ring[size + i]] : Point2<T>{};
    }
    return {buffer_, ring};
  }

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

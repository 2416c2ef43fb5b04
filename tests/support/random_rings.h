// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "trismooth/base/point2.h"

#include "support/test_meshes.h"

/// Rings for tests of single updates.
namespace random_rings {

/// A ring in memory of its own, with the interface that updates ask for.
template <class T>
struct RingOf {
  std::vector<trismooth::Point2<T>> positions;

  std::int32_t size() const { return static_cast<std::int32_t>(positions.size()); }
  trismooth::Point2<T> operator[](int i) const { return positions[static_cast<std::size_t>(i)]; }
};

/// One of quadrilaterals.
template <class T>
struct QuadrilateralRingOf {
  std::vector<trismooth::Point2<T>> positions;  ///< of the neighbours, then of the vertices opposite

  int size() const { return static_cast<int>(positions.size() / 2); }
  trismooth::Point2<T> operator[](int i) const { return positions[static_cast<std::size_t>(i)]; }
  static bool is_quadrilateral(int /*i*/) { return true; }
};

/// 3 to 14 neighbours around the origin, counter-clockwise; some rings are round, others tangled.
template <class T>
RingOf<T> any(test_meshes::Random& random) {
  const std::int32_t size = 3 + random.below(12);
  const double disorder = random.below(2) == 0 ? 0.3 : 2;
  RingOf<T> ring;
  for (std::int32_t i = 0; i < size; ++i) {
    const double angle = 2 * std::numbers::pi * (i + disorder * random.between(-1, 1)) / size;
    const double radius = 1 + random.between(-0.6, 0.6);
    ring.positions.push_back({static_cast<T>(radius * std::cos(angle)), static_cast<T>(radius * std::sin(angle))});
  }
  return ring;
}

}  // namespace random_rings

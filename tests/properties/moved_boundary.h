// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "properties/for_random_meshes.h"

namespace properties {

/// The boundary turns, is sheared, folds over, or is torn to pieces; what is free is anywhere.
inline std::vector<test_meshes::Point> moved_boundary(const RandomMesh& random, const std::vector<std::uint8_t>& held,
                                                      std::uint64_t seed) {
  test_meshes::Random dice(seed);
  const int kind = dice.below(4);
  const double angle = dice.between(-std::numbers::pi, std::numbers::pi);
  const double shear = dice.between(-2, 2);
  std::vector<test_meshes::Point> points = random.mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    test_meshes::Point& p = points[v];
    if (held[v] == 0) {
      p = {0, 0};
    } else if (kind == 0) {
      p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
    } else if (kind == 1) {
      p = {p.x + shear * p.y, p.y};
    } else if (kind == 2) {
      p = {p.x > 0.5 ? 1 - p.x : p.x, p.y};
    } else {
      p = {p.x * (1 + dice.between(-0.3, 0.3)), p.y + dice.between(-0.2, 0.2) * p.x};
    }
  }
  return points;
}

}  // namespace properties

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/test_meshes.h"

namespace test_meshes {

inline Point turned(Point p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

/// A square rotor in a round hole: rings of triangles that grow outwards, four to one.
struct Rotor {
  explicit Rotor(std::int32_t around = 64, std::int32_t between = 14) : sectors(around), rings(between) {
    for (std::int32_t j = 0; j <= rings; ++j) {
      const double radius = 1 + 3 * (std::pow(4.0, static_cast<double>(j) / rings) - 1) / 3;
      for (std::int32_t i = 0; i < sectors; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / sectors;
        const double r = j > 0 ? radius : 0.7 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        mesh.points.push_back({r * std::cos(angle), r * std::sin(angle)});
        if (j < rings) {
          const auto at = [this](std::int32_t ring, std::int32_t sector) {
            return ring * sectors + (sector + sectors) % sectors;
          };
          const std::int32_t a = at(j, i);
          const std::int32_t above = at(j + 1, j % 2 == 0 ? i : i + 1);
          mesh.triangles.push_back({a, at(j, i + 1), above});
          mesh.triangles.push_back({a, above, at(j + 1, j % 2 == 0 ? i - 1 : i)});
        }
      }
    }
  }

  bool is_on_rotor(std::size_t v) const { return v < static_cast<std::size_t>(sectors); }
  bool is_inside(std::size_t v) const { return !is_on_rotor(v) && v < static_cast<std::size_t>(sectors * rings); }
  /// With the rotor turned, in radians; what is inside is anywhere.
  std::vector<Point> at(double angle) const {
    std::vector<Point> points = mesh.points;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (is_on_rotor(v)) {
        points[v] = turned(points[v], angle);
      } else if (is_inside(v)) {
        points[v] = {7.5, -3.25};
      }
    }
    return points;
  }

  std::int32_t sectors;
  std::int32_t rings;
  Mesh mesh;
};

}  // namespace test_meshes

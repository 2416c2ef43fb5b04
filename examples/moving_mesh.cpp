// SPDX-License-Identifier: BSD-3-Clause
// A mesh that follows its boundary, as an ALE solver has it: a square rotor turns in a round domain, through 45 degrees
// and back. The same boundary gives the same mesh, to the last bit. Link with trismooth::smoothing.

#include "trismooth/smoothing/moving_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

constexpr int sectors = 96;
constexpr int rings = 24;

struct Mesh {
  std::vector<std::array<double, 2>> points;
  std::vector<std::int32_t> triangles;  // three vertex numbers each, from 0
};

/// Rings of triangles between a square and a circle, which grow outwards.
Mesh rotor_in_a_circle() {
  Mesh mesh;
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < sectors; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / sectors;
      const double square = 0.7 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
      const double radius = j == 0 ? square : std::pow(4.0, static_cast<double>(j) / rings);
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      if (j < rings) {
        const auto at = [](int ring, int sector) { return ring * sectors + (sector + sectors) % sectors; };
        const int above = at(j + 1, i + j % 2);
        mesh.triangles.insert(mesh.triangles.end(), {at(j, i), at(j, i + 1), above});
        mesh.triangles.insert(mesh.triangles.end(), {at(j, i), above, at(j + 1, i + j % 2 - 1)});
      }
    }
  }
  return mesh;
}

}  // namespace

int main() {
  const Mesh mesh = rotor_in_a_circle();
  trismooth::SmoothingOptions options = trismooth::moving_options();
  options.layers = trismooth::Layers::smooth;  // the flat triangles at the corners of the square are no layer
  trismooth::MovingMesh moving(mesh.points, mesh.triangles, options);

  auto points = mesh.points;
  std::vector<std::array<double, 2>> at_first;
  constexpr int steps = 18;
  for (int step = 0; step <= steps; ++step) {
    const double degrees = 45 * std::sin(std::numbers::pi * step / steps);
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    for (int i = 0; i < sectors; ++i) {  // those of the square alone; all others inside are where they were last
      const auto [x, y] = mesh.points[i];
      points[i] = step % steps == 0 ? mesh.points[i] : std::array{c * x - s * y, s * x + c * y};
    }
    const trismooth::FollowResult result = moving.follow(points);
    std::printf("%5.1f degrees: %lld inverted, shape relative to the reference %.3f at least, %.3f on average\n",
                degrees, static_cast<long long>(result.smoothing.inverted), result.min_relative_shape,
                result.mean_relative_shape);
    if (!result.is_valid()) {
      return 1;
    }
    if (step == 0) {
      at_first = points;
    }
  }
  std::puts(points == at_first ? "back where it was, to the last bit" : "it has drifted");
  return points == at_first ? 0 : 1;
}

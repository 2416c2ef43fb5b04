// SPDX-License-Identifier: BSD-3-Clause
// Smoothing inside a program that has a mesh of its own: two arrays are all that trismooth needs to see. It takes them
// as they are, here points with a z that is nobody's business, and vertex numbers of std::size_t.
// Here its vertices are shaken in every step, as if it moved, and smoothed again. Link with trismooth::smoothing.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/smooth.h"

namespace {

struct Mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::size_t> triangles;  // three vertex numbers each, from 0
};

/// A unit square of n x n squares, each cut into two triangles.
Mesh square(std::size_t n) {
  Mesh mesh;
  for (std::size_t row = 0; row <= n; ++row) {
    for (std::size_t column = 0; column <= n; ++column) {
      mesh.points.push_back(
          {static_cast<double>(column) / static_cast<double>(n), static_cast<double>(row) / static_cast<double>(n), 0});
      if (row < n && column < n) {
        const std::size_t v = row * (n + 1) + column;
        mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
      }
    }
  }
  return mesh;
}

/// The smallest shape of all triangles: 1 is equilateral, 0 degenerate, negative inverted.
double worst_shape(const Mesh& mesh) {
  const auto point = [&](std::size_t v) { return trismooth::Point2<double>{mesh.points[v][0], mesh.points[v][1]}; };
  double worst = 1;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::size_t* const corner = &mesh.triangles[i];
    worst = std::min(worst, trismooth::shape(point(corner[0]), point(corner[1]), point(corner[2])));
  }
  return worst;
}

}  // namespace

int main() {
  constexpr std::size_t n = 60;
  constexpr std::size_t probe = (n / 2) * (n + 1) + n / 2;
  Mesh mesh = square(n);

  // The boundary is fixed in any case. Name what else must stay: here a probe in the middle.
  std::vector<std::uint8_t> fixed(mesh.points.size(), 0);
  fixed[probe] = 1;
  trismooth::Constraints constraints;
  constraints.fixed = fixed;

  // The plan analyses the triangles once; smoothing with it again costs the sweeps alone.
  auto plan = trismooth::plan(static_cast<std::int64_t>(mesh.points.size()), mesh.triangles, constraints);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shake(-0.3 / n, 0.3 / n);
  for (int step = 1; step <= 2; ++step) {
    for (std::size_t row = 1; row < n; ++row) {
      for (std::size_t v = row * (n + 1) + 1; v < row * (n + 1) + n; ++v) {
        mesh.points[v][0] += v == probe ? 0 : shake(random);
        mesh.points[v][1] += v == probe ? 0 : shake(random);
      }
    }
    const double before = worst_shape(mesh);
    const trismooth::SmoothingResult result = plan.smooth(mesh.points);
    const double after = worst_shape(mesh);
    std::printf("step %d: %lld sweeps, %lld vertices moved, worst shape %.3f -> %.3f\n", step,
                static_cast<long long>(result.sweeps), static_cast<long long>(result.moved_vertices), before, after);
    if (!(after > before) || mesh.points[probe] != std::array{0.5, 0.5, 0.0}) {
      return 1;
    }
  }
}

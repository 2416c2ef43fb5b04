// SPDX-License-Identifier: BSD-3-Clause
// A method of the program's own: the angle-based smoothing of Zhou and Shimada (2000). trismooth asks it for each
// vertex where that is to go, by colours and on all threads, and keeps the mesh valid. Link with trismooth::smoothing.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <random>
#include <vector>

#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

namespace {

using Point = trismooth::Point2<double>;

/// Each neighbour turns the edge to the vertex about itself until it halves the angle between its edges to the next
/// neighbours; the vertex is to go to the mean of the places where that puts it.
std::optional<Point> angle_based(const trismooth::VertexNeighbourhood& around) {
  const std::size_t count = around.neighbours.size();
  Point sum{0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const Point pivot = around.neighbours[i];
    const auto seen_from_pivot = [pivot](Point p) { return Point{p.x - pivot.x, p.y - pivot.y}; };
    const auto angle = [](Point from, Point to) {
      return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
    };
    const Point edge = seen_from_pivot(around.position);
    const Point next = seen_from_pivot(around.neighbours[(i + 1) % count]);
    const Point previous = seen_from_pivot(around.neighbours[(i + count - 1) % count]);
    const double turn = (angle(edge, previous) - angle(next, edge)) / 2;
    sum.x += pivot.x + edge.x * std::cos(turn) - edge.y * std::sin(turn);
    sum.y += pivot.y + edge.x * std::sin(turn) + edge.y * std::cos(turn);
  }
  return Point{sum.x / static_cast<double>(count), sum.y / static_cast<double>(count)};
}

struct Mesh {
  std::vector<std::array<double, 2>> points;
  std::vector<std::int32_t> triangles;  // three vertex numbers each, from 0
};

/// A unit square of n x n squares, each cut into two triangles, whose vertices are shaken.
Mesh shaken_square(std::int32_t n) {
  Mesh mesh;
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> shake(-0.4 / n, 0.4 / n);
  for (std::int32_t row = 0; row <= n; ++row) {
    for (std::int32_t column = 0; column <= n; ++column) {
      const bool is_inside = row > 0 && row < n && column > 0 && column < n;
      const auto place = [&](std::int32_t i) { return static_cast<double>(i) / n + (is_inside ? shake(bits) : 0); };
      mesh.points.push_back({place(column), place(row)});
      if (row < n && column < n) {
        const std::int32_t v = row * (n + 1) + column;
        mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
      }
    }
  }
  return mesh;
}

void report(const char* name, const Mesh& mesh) {
  const trismooth::MetricSummary shape = trismooth::quality(mesh.points, mesh.triangles)[trismooth::Metric::shape];
  std::printf("%-12s  smallest shape %6.3f, mean %.3f\n", name, shape.min, shape.mean);
}

}  // namespace

int main() {
  const Mesh input = shaken_square(60);
  report("before", input);

  trismooth::SmoothingOptions options;
  Mesh smart = input;
  trismooth::smooth(smart.points, smart.triangles, options);
  report("smart", smart);

  options.proposal.place = &angle_based;
  options.proposal.accept = trismooth::Acceptance::always;
  options.max_sweeps = 30;
  Mesh mesh = input;
  const trismooth::SmoothingResult result = trismooth::smooth(mesh.points, mesh.triangles, options);
  report("angle-based", mesh);

  std::printf("%lld sweeps; the guard took %lld vertices back\n", static_cast<long long>(result.sweeps),
              static_cast<long long>(result.reverted_vertices));
  const auto worst = [](const Mesh& of) {
    return trismooth::quality(of.points, of.triangles)[trismooth::Metric::shape].min;
  };
  return worst(mesh) > worst(input) && result.inverted == 0 ? 0 : 1;
}

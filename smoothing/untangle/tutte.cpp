// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/tutte.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/smoothing/systems/conjugate_gradients.h"
#include "trismooth/smoothing/systems/host_rows.h"

namespace trismooth {

void tutte(const Patch& patch, std::span<Point2<double>> points, double tolerance, Workers& workers) {
  const auto free = points.first(static_cast<std::size_t>(patch.free_count));
  const RingView rings = patch.rings();
  const auto degree = [&](std::int32_t v) { return static_cast<double>(rings[v].size()); };
  // A row of the matrix times x, where held vertices are 0.
  const auto apply = [&](const Point2<double>* x, std::int32_t v) {
    Point2<double> sum{degree(v) * x[v].x, degree(v) * x[v].y};
    for (const std::int32_t neighbour : rings[v]) {
      if (neighbour < patch.free_count) {
        sum.x -= x[neighbour].x;
        sum.y -= x[neighbour].y;
      }
    }
    return sum;
  };
  const auto precondition = [&](std::int32_t v, Point2<double> r) {
    return Point2<double>{r.x / degree(v), r.y / degree(v)};
  };
  // The pull of the neighbours where they are, seen from the centre of the held ones, so that no digit is lost on it.
  Point2<double> centre{0, 0};
  for (const Point2<double> p : points.subspan(free.size())) {
    centre.x += p.x;
    centre.y += p.y;
  }
  const double held = static_cast<double>(points.size() - free.size());
  centre = {centre.x / held, centre.y / held};
  std::vector<Point2<double>> residual(free.size());
  const double reference = std::sqrt(ordered_sum(
      patch.free_count,
      [&](std::int32_t v) {
        Point2<double> pull{0, 0};
        Point2<double> load{0, 0};
        for (const std::int32_t neighbour : rings[v]) {
          pull.x += points[neighbour].x - points[v].x;
          pull.y += points[neighbour].y - points[v].y;
          if (neighbour >= patch.free_count) {
            load.x += points[neighbour].x - centre.x;
            load.y += points[neighbour].y - centre.y;
          }
        }
        residual[v] = pull;
        return (load.x * load.x + load.y * load.y) / degree(v);
      },
      workers));
  constexpr int most_steps = 20000;
  HostRows rows(workers);
  conjugate_gradients(apply, precondition, patch.free_count, free.data(), residual.data(), reference, tolerance,
                      most_steps, rows);
}

}  // namespace trismooth

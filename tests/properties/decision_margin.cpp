// SPDX-License-Identifier: BSD-3-Clause
#include "properties/decision_margin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "support/naive_smoothing.h"

namespace properties {

namespace {

using Real = long double;
using Points = std::vector<Point2<Real>>;
using trismooth::Triangle;

constexpr Real infinity = std::numeric_limits<Real>::infinity();

Real distance(Point2<Real> a, Point2<Real> b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The shortest edge between a position and its ring, and along the ring.
Real shortest_edge(Point2<Real> position, const naive::Ring<Real>& ring) {
  Real shortest = infinity;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    shortest = std::min({shortest, distance(position, ring[i]), distance(ring[i], ring[(i + 1) % ring.size()])});
  }
  return shortest;
}

Real smallest_magnitude(Point2<Real> position, const naive::Ring<Real>& ring) {
  Real smallest = infinity;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    smallest = std::min(smallest, std::abs(naive::quotient(position, ring[i], ring[(i + 1) % ring.size()])));
  }
  return smallest;
}

Real margin_of_move(Method method, Point2<Real> position, Point2<Real> target, const naive::Ring<Real>& ring) {
  // Whether a vertex takes a step of rounding alone makes no difference.
  constexpr Real rounding = 1e-14L;
  if (distance(position, target) < rounding) {
    return infinity;
  }
  Real margin = infinity;
  if (method != Method::laplacian) {
    const Real before = naive::smallest_quotient(position, ring);
    Real quality = std::abs(naive::smallest_quotient(target, ring) - before);
    if (before < 0) {
      quality = std::min({quality, smallest_magnitude(position, ring), smallest_magnitude(target, ring)});
    }
    margin = std::min(margin, quality * std::min(shortest_edge(position, ring), shortest_edge(target, ring)));
  }
  return margin;
}

Real quotient(const Points& points, const Triangle& t) {
  return naive::quotient(points[t[0]], points[t[1]], points[t[2]]);
}

/// Of the guard, every round of which takes all decisions again.
Real margin_of_commit(const std::vector<Triangle>& elements, const Points& before, Points after) {
  const auto has_moved = [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::int32_t v) { return !(before[v] == after[v]); });
  };
  Real margin = infinity;
  for (bool changed = true; changed;) {
    changed = false;
    Real threshold = infinity;
    for (const Triangle& t : elements) {
      threshold = has_moved(t) ? std::min(threshold, quotient(before, t)) : threshold;
    }
    std::set<std::int32_t> back;
    for (const Triangle& t : elements) {
      if (!has_moved(t)) {
        continue;
      }
      const Real was = quotient(before, t);
      const Real is = quotient(after, t);
      const Real quality = std::min({std::abs(was), std::abs(is), std::abs(is - threshold), std::abs(is - was)});
      Real edge = infinity;
      for (std::size_t i = 0; i < 3; ++i) {
        edge = std::min(
            {edge, distance(before[t[i]], before[t[(i + 1) % 3]]), distance(after[t[i]], after[t[(i + 1) % 3]])});
      }
      margin = std::min(margin, quality * edge);
      if ((was > 0 && !(is > 0)) || (is < threshold && is < was)) {
        back.insert(t.begin(), t.end());
        changed = true;
      }
    }
    for (const std::int32_t v : back) {
      after[v] = before[v];
    }
  }
  return margin;
}

}  // namespace

double decision_margin(const RandomMesh& mesh, const Connectivity& connectivity, const SmoothingOptions& options) {
  std::set<std::int32_t> fixed;
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (connectivity.fixed[v]) {
      fixed.insert(v);
    }
  }
  const naive::Rings rings = naive::one_rings(mesh.mesh.vertex_count(), connectivity.elements, fixed);
  Points before;
  for (const Point2<double> p : mesh.mesh.points) {
    before.push_back({p.x, p.y});
  }
  Points points = before;
  Real margin = infinity;
  for (std::int64_t sweep = 0; sweep < options.max_sweeps; ++sweep) {
    const Points old = points;
    const Points& source = options.form == Form::swap ? old : points;
    for (const auto& colour : naive::colour_classes(rings)) {
      for (const std::int32_t v : colour) {
        naive::Ring<Real> ring;
        for (const std::int32_t neighbour : rings[v]) {
          ring.push_back(source[neighbour]);
        }
        const Point2<Real> position = source[v];
        const Point2<Real> mean =
            options.method == Method::weighted ? naive::weighted(position, ring) : naive::laplacian(ring);
        margin = std::min(margin, margin_of_move(options.method, position, mean, ring));
        if (options.guard && position == before[v]) {
          // It does to the guard, which looks at all elements that were touched.
          margin = std::min(margin, distance(position, mean));
        }
        points[v] = naive::updated(options.method, position, ring);
      }
    }
  }
  if (options.guard) {
    margin = std::min(margin, margin_of_commit(connectivity.elements, before, points));
  }
  return static_cast<double>(margin);
}

}  // namespace properties

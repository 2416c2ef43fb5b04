// SPDX-License-Identifier: BSD-3-Clause
#include "support/tangled_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/pipeline/generate/delaunay.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"

namespace tangled_meshes {

namespace {

using test_meshes::Point;
using test_meshes::Random;
using trismooth::GridPoint;
using trismooth::Triangle;

constexpr double grid_size = 1 << 29;

GridPoint on_grid(Point p) {
  return {static_cast<std::int32_t>(grid_size * p.x), static_cast<std::int32_t>(grid_size * p.y)};
}

/// The Delaunay mesh of the points, those that fall together left out.
Mesh delaunay_mesh(const std::vector<Point>& points, Random& random) {
  std::set<GridPoint> different;
  for (const Point p : points) {
    different.insert(on_grid(p));
  }
  std::vector<GridPoint> grid(different.begin(), different.end());
  random.shuffle(grid);
  Mesh mesh;
  for (const GridPoint& p : grid) {
    mesh.points.push_back({p[0] / grid_size, p[1] / grid_size});
  }
  mesh.triangles = trismooth::delaunay(grid);
  return mesh;
}

/// Random points of the unit square with its sides divided alike, none near a side.
std::vector<Point> square_points(std::int32_t count, Random& random) {
  const auto side = std::max(2, static_cast<std::int32_t>(std::sqrt(count)));
  std::vector<Point> points;
  for (std::int32_t i = 0; i < side; ++i) {
    const double at = static_cast<double>(i) / side;
    points.insert(points.end(), {{at, 0}, {1, at}, {1 - at, 1}, {0, 1 - at}});
  }
  const double margin = 0.2 / side;
  while (static_cast<std::int32_t>(points.size()) < count) {
    const double x = random.between(margin, 1 - margin);
    points.push_back({x, random.between(margin, 1 - margin)});
  }
  return points;
}

/// The mesh without the triangles whose centre is not `inside`.
template <class Inside>
Mesh carved(const Mesh& mesh, const Inside& inside) {
  Mesh result;
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    const Point a = mesh.points[t[0]];
    const Point b = mesh.points[t[1]];
    const Point c = mesh.points[t[2]];
    if (!inside(Point{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3})) {
      continue;
    }
    Triangle numbered{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (number[t[i]] < 0) {
        number[t[i]] = result.vertex_count();
        result.points.push_back(mesh.points[t[i]]);
      }
      numbered[i] = number[t[i]];
    }
    result.triangles.push_back(numbered);
  }
  return result;
}

bool is_valid(const Mesh& mesh) {
  return std::ranges::all_of(mesh.triangles, [&](const Triangle& t) {
    return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]) > 0;
  });
}

/// The mesh with every point p at place(p, strength), with the largest strength below `strength` that leaves every
/// triangle valid.
template <class Place>
Mesh warped(const Mesh& mesh, double strength, const Place& place) {
  for (;; strength *= 0.8) {
    Mesh result = mesh;
    for (Point& p : result.points) {
      p = place(p, strength);
    }
    if (is_valid(result)) {
      return result;
    }
  }
}

double distance(Point a, Point b) {
  return std::sqrt(squared_length(a - b));
}

bool in_ring(Point p) {
  const double radius = distance(p, {0.5, 0.5});
  return radius > 0.25 && radius < 0.5;
}

bool in_spiral(Point p) {
  const double radius = distance(p, {0.5, 0.5});
  const double turns = std::atan2(p.y - 0.5, p.x - 0.5) / (2 * std::numbers::pi) + 0.5;
  const double along = radius * 7 - turns;
  return radius > 0.08 && radius < 0.48 && along - std::floor(along) < 0.7;
}

bool in_comb(Point p) {
  return p.y < 0.25 || static_cast<std::int32_t>(p.x * 9) % 2 == 0;
}

bool outside_holes(Point p) {
  return distance(p, {0.3, 0.3}) > 0.15 && distance(p, {0.7, 0.35}) > 0.12 && distance(p, {0.45, 0.72}) > 0.2 &&
         distance(p, {0.85, 0.8}) > 0.07;
}

Mesh domain_mesh(Domain domain, std::int32_t count, Random& random) {
  switch (domain) {
    case Domain::disc: {
      std::vector<Point> points;
      const auto rim = static_cast<std::int32_t>(2 * std::sqrt(std::numbers::pi * count));
      for (std::int32_t i = 0; i < rim; ++i) {
        const double angle = 2 * std::numbers::pi * i / rim;
        points.push_back({0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)});
      }
      while (static_cast<std::int32_t>(points.size()) < count) {
        const double x = random.between(0, 1);
        const Point p{x, random.between(0, 1)};
        if (distance(p, {0.5, 0.5}) < 0.5 - 1.0 / rim) {
          points.push_back(p);
        }
      }
      return delaunay_mesh(points, random);
    }
    case Domain::hull: {
      std::vector<Point> points;
      for (std::int32_t i = 0; i < count; ++i) {
        const double x = random.between(0, 1);
        points.push_back({x, random.between(0, 1)});
      }
      return delaunay_mesh(points, random);
    }
    case Domain::graded: {
      std::vector<Point> points = square_points(count, random);
      for (Point& p : points) {
        p = {p.x * (0.05 + 0.95 * p.x), p.y * (0.05 + 0.95 * p.y)};
      }
      return delaunay_mesh(points, random);
    }
    case Domain::corner:
      return carved(delaunay_mesh(square_points(count * 4 / 3, random), random),
                    [](Point p) { return p.x < 0.5 || p.y < 0.5; });
    case Domain::comb:
    case Domain::flat_comb:
      return carved(delaunay_mesh(square_points(count * 3 / 2, random), random), in_comb);
    case Domain::holes:
      return carved(delaunay_mesh(square_points(count * 4 / 3, random), random), outside_holes);
    case Domain::ring:
      return carved(delaunay_mesh(square_points(count * 2, random), random), in_ring);
    case Domain::twisted:
      return warped(carved(delaunay_mesh(square_points(count * 2, random), random), in_ring), 3,
                    [](Point p, double strength) {
                      const double turn = strength * (0.5 - distance(p, {0.5, 0.5})) / 0.25;
                      const Point d = p - Point{0.5, 0.5};
                      return Point{0.5 + d.x * std::cos(turn) - d.y * std::sin(turn),
                                   0.5 + d.x * std::sin(turn) + d.y * std::cos(turn)};
                    });
    case Domain::wave:
      return warped(delaunay_mesh(square_points(count, random), random), 1, [](Point p, double strength) {
        return Point{p.x, p.y + strength * std::sin(9 * p.x)};
      });
    case Domain::spiral:
      return carved(delaunay_mesh(square_points(count * 2, random), random), in_spiral);
    case Domain::square:
    case Domain::flat:
    case Domain::regions:
      break;
  }
  return delaunay_mesh(square_points(count, random), random);
}

}  // namespace

std::string_view name_of(Domain domain) {
  constexpr std::array<std::string_view, all_domains.size()> names{"square",  "disc",    "hull",  "graded", "flat",
                                                                   "corner",  "comb",    "holes", "ring",   "flat comb",
                                                                   "regions", "twisted", "wave",  "spiral"};
  return names[static_cast<std::size_t>(domain)];
}

std::string_view name_of(Tangle tangle) {
  constexpr std::array<std::string_view, all_tangles.size()> names{"3 % displaced", "30 % displaced", "all displaced",
                                                                   "one point", "anywhere"};
  return names[static_cast<std::size_t>(tangle)];
}

ValidMesh valid_mesh(Domain domain, std::int32_t vertices, std::uint64_t seed) {
  Random random(seed * 1000003 + static_cast<std::uint64_t>(domain));
  ValidMesh valid;
  valid.mesh = domain_mesh(domain, std::max(vertices, 16), random);
  if (domain == Domain::flat || domain == Domain::flat_comb) {
    for (Point& p : valid.mesh.points) {
      p.y *= domain == Domain::flat ? 0.02 : 0.1;
    }
  }
  if (domain == Domain::regions) {
    for (const Triangle& t : valid.mesh.triangles) {
      const Point p = valid.mesh.points[t[0]];
      valid.regions.push_back(outside_holes(p) ? (p.x + 0.3 * p.y < 0.6 ? 1 : 2) : 3);
    }
  }
  trismooth::Workers workers(1);
  const auto topology = trismooth::connect_triangles(valid.mesh.vertex_count(), valid.mesh.triangles, workers);
  valid.fixed = trismooth::fixed_vertices(topology, valid.mesh.triangles, valid.constraints());
  return valid;
}

CutMesh cut_in_quadrilaterals(const ValidMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.mesh.triangles;
  CutMesh cut{mesh, {}, {}};
  cut.in_triangles.mesh.triangles.clear();
  cut.in_triangles.regions.clear();
  std::vector<Point>& points = cut.in_triangles.mesh.points;
  struct Side {
    std::int32_t middle;
    std::vector<std::size_t> triangles;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Side> sides;
  const auto side = [&](std::int32_t a, std::int32_t b) -> Side& { return sides[{std::min(a, b), std::max(a, b)}]; };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i];
      const std::int32_t b = triangles[t][(i + 1) % 3];
      Side& found = side(a, b);
      if (found.triangles.empty()) {
        found.middle = static_cast<std::int32_t>(points.size());
        points.push_back({0.5 * (points[a].x + points[b].x), 0.5 * (points[a].y + points[b].y)});
      }
      found.triangles.push_back(t);
    }
  }
  std::vector<std::uint8_t>& fixed = cut.in_triangles.fixed;
  fixed.resize(points.size() + triangles.size(), 0);
  for (const auto& [ends, found] : sides) {
    const bool is_border =
        found.triangles.size() != 2 ||
        (!mesh.regions.empty() && mesh.regions[found.triangles[0]] != mesh.regions[found.triangles[1]]);
    fixed[static_cast<std::size_t>(found.middle)] = is_border ? 1 : 0;
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    const auto middle = static_cast<std::int32_t>(points.size());
    points.push_back({(points[a].x + points[b].x + points[c].x) / 3, (points[a].y + points[b].y + points[c].y) / 3});
    for (const auto& [before, corner, behind] : {Triangle{c, a, b}, Triangle{a, b, c}, Triangle{b, c, a}}) {
      const std::int32_t next = side(corner, behind).middle;
      const std::int32_t previous = side(before, corner).middle;
      const std::array halves{Triangle{corner, next, middle}, Triangle{corner, middle, previous}};
      const trismooth::MixedElement quadrilateral{corner, next, middle, previous};
      cut.quadrilaterals.push_back(quadrilateral);
      for (const Triangle& half : halves) {
        cut.in_triangles.mesh.triangles.push_back(half);
        if (!mesh.regions.empty()) {
          cut.in_triangles.regions.push_back(mesh.regions[t]);
        }
      }
      if (cut.quadrilaterals.size() % 2 == 0) {
        cut.both.push_back(quadrilateral);
      } else {
        std::ranges::transform(halves, std::back_inserter(cut.both),
                               [](const Triangle& half) { return trismooth::as_mixed(half); });
      }
    }
  }
  return cut;
}

std::vector<Point> displaced_points(const ValidMesh& mesh, double part, double edges, std::uint64_t seed) {
  Random random(seed + 77);
  const std::vector<Point>& valid = mesh.mesh.points;
  std::vector<double> lengths(valid.size());
  std::vector<double> counts(valid.size());
  for (const Triangle& t : mesh.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = distance(valid[t[i]], valid[t[(i + 1) % 3]]);
      for (const std::int32_t v : {t[i], t[(i + 1) % 3]}) {
        lengths[v] += length;
        counts[v] += 1;
      }
    }
  }
  std::vector<Point> points = valid;
  bool is_first = true;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (mesh.fixed[v] != 0) {
      continue;
    }
    const double angle = random.between(0, 2 * std::numbers::pi);
    const double by = random.between(0, edges) * lengths[v] / counts[v];
    if (random.between(0, 1) < part || is_first) {
      points[v] = {points[v].x + by * std::cos(angle), points[v].y + by * std::sin(angle)};
      is_first = false;
    }
  }
  return points;
}

void fold_by_held_vertices(ValidMesh& mesh, std::int32_t count, std::uint64_t seed) {
  Random random(seed + 55);
  std::vector<std::vector<std::int32_t>> neighbours(mesh.mesh.points.size());
  for (const Triangle& t : mesh.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      neighbours[t[i]].push_back(t[(i + 1) % 3]);
    }
  }
  const std::vector<Point> valid = mesh.mesh.points;
  const std::vector<std::uint8_t> fixed = mesh.fixed;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t v = random.below(mesh.mesh.vertex_count());
    const auto& ring = neighbours[v];
    if (fixed[v] != 0 || std::ranges::any_of(ring, [&](std::int32_t n) { return mesh.fixed[n] != 0; })) {
      continue;
    }
    for (const std::int32_t n : ring) {
      mesh.fixed[n] = 1;
    }
    const auto farthest = *std::ranges::max_element(
        ring, {}, [&](std::int32_t n) { return squared_length(valid[n] - valid[ring.front()]); });
    mesh.mesh.points[ring.front()] = {2 * valid[farthest].x - valid[v].x, 2 * valid[farthest].y - valid[v].y};
  }
}

std::vector<Point> tangled_points(const ValidMesh& mesh, Tangle tangle, std::uint64_t seed) {
  switch (tangle) {
    case Tangle::some_displaced:
      return displaced_points(mesh, 0.03, 3, seed);
    case Tangle::many_displaced:
      return displaced_points(mesh, 0.3, 3, seed);
    case Tangle::all_displaced:
      return displaced_points(mesh, 1, 3, seed);
    case Tangle::one_point:
    case Tangle::anywhere:
      break;
  }
  Random random(seed + 99);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low{infinity, infinity};
  Point high{-infinity, -infinity};
  for (const Point p : mesh.mesh.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::vector<Point> points = mesh.mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (mesh.fixed[v] != 0) {
      continue;
    }
    const double x = random.between(low.x, high.x);
    const double y = random.between(low.y, high.y);
    points[v] = tangle == Tangle::anywhere ? Point{x, y} : Point{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
  }
  return points;
}

}  // namespace tangled_meshes

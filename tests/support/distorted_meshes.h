// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "trismooth/pipeline/generate/delaunay.h"

#include "support/test_meshes.h"

/// Meshes of the unit square, distorted in ways that users' meshes are, for tests and benchmarks. Their boundaries are
/// as fine as their insides and stay where they are.
namespace distorted_meshes {

using test_meshes::Mesh;
using test_meshes::Point;

/// side x side vertices in a grid, each square cut from lower left to upper right; `place` maps them.
template <class Place>
Mesh grid(std::int32_t side, const Place& place) {
  Mesh mesh;
  for (std::int32_t row = 0; row < side; ++row) {
    for (std::int32_t column = 0; column < side; ++column) {
      const std::int32_t a = row * side + column;
      mesh.points.push_back(
          place(Point{static_cast<double>(column) / (side - 1), static_cast<double>(row) / (side - 1)}));
      if (row + 1 < side && column + 1 < side) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + side + 1}, {a, a + side + 1, a + side}});
      }
    }
  }
  return mesh;
}

inline bool is_inside(Point p) {
  return p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
}

/// A grid in ten steep waves: all triangles valid, mean shape 0.2, smallest 0.004. From some 100 vertices a side on,
/// which resolve the waves, its shapes do not depend on their number.
inline Mesh wave(std::int32_t side) {
  return grid(side, [](Point p) {
    const double pi = std::numbers::pi;
    return is_inside(p)
               ? Point{p.x, p.y + 0.31 * std::sqrt(std::sin(pi * p.x)) * std::sin(pi * p.y) * std::sin(20 * pi * p.x)}
               : p;
  });
}

/// A grid whose inner vertices are displaced by up to `part` of its spacing in x and in y. At 0.45 some triangles are
/// inverted.
inline Mesh displaced(std::int32_t side, double part, std::uint64_t seed) {
  test_meshes::Random random(seed);
  const double most = part / (side - 1);
  return grid(side, [&](Point p) {
    const Point by{random.between(-most, most), random.between(-most, most)};
    return is_inside(p) ? Point{p.x + by.x, p.y + by.y} : p;
  });
}

/// The Delaunay mesh of about side x side points: hexagonal ones, displaced by up to `part` of their spacing in x and
/// in y, and others on the sides at their spacing. None inside is nearer to a side than a fifth of it.
inline Mesh hexagonal(std::int32_t side, double part, std::uint64_t seed) {
  test_meshes::Random random(seed);
  const double spacing = std::sqrt(2 / std::numbers::sqrt3) / side;
  const auto edges = static_cast<std::int32_t>(std::lround(1 / spacing));
  Mesh mesh;
  for (std::int32_t i = 0; i < edges; ++i) {
    const double t = static_cast<double>(i) / edges;
    mesh.points.insert(mesh.points.end(), {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}});
  }
  const double rise = spacing * std::numbers::sqrt3 / 2;
  const double least = spacing / 5;
  for (std::int32_t row = 1; row * rise < 1; ++row) {
    for (std::int32_t column = 0; column * spacing < 1; ++column) {
      const Point place{(column + 0.5 * (row % 2)) * spacing, row * rise};
      const Point p{place.x + part * spacing * random.between(-1, 1), place.y + part * spacing * random.between(-1, 1)};
      const double depth = std::min({place.x, place.y, 1 - place.x, 1 - place.y});
      if (depth > spacing / 2 && std::min({p.x, p.y, 1 - p.x, 1 - p.y}) > least) {
        mesh.points.push_back(p);
      }
    }
  }
  constexpr std::int32_t steps = 1 << (trismooth::grid_bits - 1);
  std::vector<trismooth::GridPoint> places;
  for (Point& p : mesh.points) {
    places.push_back(
        {static_cast<std::int32_t>(std::lround(p.x * steps)), static_cast<std::int32_t>(std::lround(p.y * steps))});
    p = {static_cast<double>(places.back()[0]) / steps, static_cast<double>(places.back()[1]) / steps};
  }
  mesh.triangles = trismooth::delaunay(places);
  return mesh;
}

}  // namespace distorted_meshes

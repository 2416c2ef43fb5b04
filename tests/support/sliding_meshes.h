// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "support/distorted_meshes.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

/// Meshes whose lines are known, their vertices unevenly spaced on these, and what becomes of them.
namespace sliding_meshes {

using test_meshes::Mesh;
using test_meshes::Point;

/// A grid whose inner vertices are off their places by up to `part` of its spacing, and those on the sides along these.
inline Mesh uneven_square(std::int32_t side, double part, std::uint64_t seed) {
  test_meshes::Random random(seed);
  return distorted_meshes::grid(side, [&](Point p) {
    const double most = part / (side - 1);
    const Point by{random.between(-most, most), random.between(-most, most)};
    return Point{p.x > 0 && p.x < 1 ? p.x + by.x : p.x, p.y > 0 && p.y < 1 ? p.y + by.y : p.y};
  });
}

/// A grid of cells twice as long as high, all halved alike, of which one inner vertex in ten is off its place: where it
/// slides, it shears as a whole, and nearly all of it would have to go back.
inline Mesh regular_grid(std::int32_t side, std::uint64_t seed) {
  test_meshes::Random random(seed);
  return distorted_meshes::grid(side, [&](Point p) {
    const bool is_off = random.below(10) == 0 && distorted_meshes::is_inside(p);
    const double most = is_off ? 0.1 / (side - 1) : 0;
    return Point{2 * p.x + random.between(-most, most), p.y + random.between(-most, most)};
  });
}

/// Rings of `around` vertices from radius 0.3 to 1, those of each circle unevenly spaced on it. Ring r has the vertices
/// from r * around on.
inline Mesh uneven_annulus(std::int32_t around, std::int32_t rings, std::uint64_t seed) {
  test_meshes::Random random(seed);
  Mesh mesh;
  for (std::int32_t r = 0; r < rings; ++r) {
    for (std::int32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.between(-0.35, 0.35)) / around;
      const double radius = 0.3 + 0.7 * r / (rings - 1);
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  for (std::int32_t r = 0; r + 1 < rings; ++r) {
    for (std::int32_t i = 0; i < around; ++i) {
      const std::int32_t a = r * around + i;
      const std::int32_t b = r * around + (i + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + around, b}, {b, a + around, b + around}});
    }
  }
  return mesh;
}

/// Adds another mesh as a component of its own. Returns the number of its first vertex.
inline std::int32_t add(Mesh& mesh, const Mesh& other) {
  const std::int32_t first = mesh.vertex_count();
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const trismooth::Triangle& t : other.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return first;
}

/// Two uneven squares, one on the right of the other, whose vertices on the common side are within `gap` of each other
/// along both axes, and do not overlap.
struct TwoSquares {
  std::int32_t side;
  Mesh mesh;
  std::int32_t second;

  TwoSquares(std::int32_t side_of_both, double gap)
      : side(side_of_both), mesh(uneven_square(side, 0.35, 3)), second(add(mesh, uneven_square(side, 0.35, 4))) {
    test_meshes::Random random(5);
    for (std::int32_t v = second; v < mesh.vertex_count(); ++v) {
      mesh.points[v].x += 1;
    }
    for (std::int32_t j = 0; j < side; ++j) {
      mesh.points[right_of(j)] = mesh.points[left_of(j)];
      mesh.points[right_of(j)].x += random.between(0, gap);
      mesh.points[right_of(j)].y += random.between(-gap, gap);
    }
  }

  std::int32_t left_of(std::int32_t j) const { return j * side + side - 1; }
  std::int32_t right_of(std::int32_t j) const { return second + j * side; }
};

struct Smoothed {
  std::vector<double> xy;
  trismooth::SmoothingResult result;

  Point at(std::int32_t v) const { return {xy[2 * v], xy[2 * v + 1]}; }
};

inline Smoothed smoothed(const Mesh& mesh, const trismooth::Constraints& constraints,
                         trismooth::Method method = trismooth::Method::mean_ratio) {
  Smoothed found{mesh.xy(), {}};
  trismooth::SmoothingOptions options;
  options.method = method;
  options.layers = trismooth::Layers::smooth;  // annuli of many sectors are flat all over
  found.result = trismooth::smooth(trismooth::xy_points(found.xy), mesh.indices(), constraints, options);
  return found;
}

/// Whether a vertex is where it was.
inline bool is_at(const Smoothed& found, const Mesh& mesh, std::int32_t v) {
  return same_bits(found.xy[2 * v], mesh.points[v].x) && same_bits(found.xy[2 * v + 1], mesh.points[v].y);
}

}  // namespace sliding_meshes

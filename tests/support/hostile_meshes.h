// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "trismooth/base/splitmix64.h"

#include "support/mixed_meshes.h"
#include "support/test_meshes.h"

/// Meshes and points that somebody made to keep a program busy. They are small files all the same, and are to take
/// the time of small files.
namespace hostile_meshes {

using test_meshes::Mesh;
using test_meshes::Point;

/// `length` free vertices in a row, each of which is coloured before its left neighbour: whoever colours in rounds
/// colours one a round. Vertices 0 .. length - 1 are the row, the others the boundary below and above it.
inline Mesh chain(std::int32_t length) {
  std::vector<std::int32_t> row(static_cast<std::size_t>(length));
  std::iota(row.begin(), row.end(), 0);
  std::ranges::sort(row, [](std::int32_t a, std::int32_t b) { return trismooth::coloured_before(b, a); });
  Mesh mesh;
  mesh.points.resize(3 * static_cast<std::size_t>(length) + 2);
  const auto below = [&](std::int32_t k) { return length + k; };
  const auto above = [&](std::int32_t k) { return 2 * length + 1 + k; };
  for (std::int32_t k = 0; k <= length; ++k) {
    mesh.points[below(k)] = {k + 0.5, 0};
    mesh.points[above(k)] = {k + 0.5, 1};
  }
  for (std::int32_t k = 0; k < length; ++k) {
    mesh.points[row[k]] = {k + 1.0 + (k % 2 == 0 ? 0 : 0.2), 0.5};
    mesh.triangles.push_back({below(k), below(k + 1), row[k]});
    mesh.triangles.push_back({above(k + 1), above(k), row[k]});
    if (k + 1 < length) {
      mesh.triangles.push_back({below(k + 1), row[k + 1], row[k]});
      mesh.triangles.push_back({row[k], row[k + 1], above(k + 1)});
    }
  }
  mesh.triangles.push_back({above(0), below(0), row.front()});
  mesh.triangles.push_back({below(length), above(length), row.back()});
  return mesh;
}

/// Vertex 0 in the middle of `spokes` free vertices, which stand within a ring of fixed ones.
inline Mesh wheel(std::int32_t spokes) {
  Mesh mesh;
  mesh.points.push_back({0.01, 0.02});
  for (const double radius : {1.0, 2.0}) {
    for (std::int32_t i = 0; i < spokes; ++i) {
      const double angle = 2 * std::numbers::pi * i / spokes;
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  for (std::int32_t i = 0; i < spokes; ++i) {
    const std::int32_t a = 1 + i;
    const std::int32_t b = 1 + (i + 1) % spokes;
    mesh.triangles.insert(mesh.triangles.end(), {{0, a, b}, {a, a + spokes, b + spokes}, {a, b + spokes, b}});
  }
  return mesh;
}

/// `blades` triangles that share vertex 0 and nothing else.
inline Mesh windmill(std::int32_t blades) {
  Mesh mesh;
  mesh.points.push_back({0, 0});
  for (std::int32_t i = 0; i < 2 * blades; ++i) {
    const double angle = std::numbers::pi * i / blades;
    mesh.points.push_back({std::cos(angle), std::sin(angle)});
    if (i % 2 == 1) {
      mesh.triangles.push_back({0, i, i + 1});
    }
  }
  return mesh;
}

/// `pages` triangles on one edge.
inline Mesh book(std::int32_t pages) {
  Mesh mesh;
  mesh.points = {{0, 0}, {0, 1}};
  for (std::int32_t i = 0; i < pages; ++i) {
    mesh.points.push_back({1.0 + i, 0.5});
    mesh.triangles.push_back({0, i + 2, 1});
  }
  return mesh;
}

/// A mesh of triangles, each of which is cut into three quadrilaterals.
inline mixed_meshes::MixedMesh in_quadrilaterals(const Mesh& mesh) {
  mixed_meshes::MixedMesh cut;
  const auto middle_of = [&](const auto&... corners) {
    const double weight = 1.0 / sizeof...(corners);
    cut.points.push_back({weight * (mesh.points[corners].x + ...), weight * (mesh.points[corners].y + ...)});
    return cut.vertex_count() - 1;
  };
  for (const Point& point : mesh.points) {
    cut.points.push_back({point.x, point.y});
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle_of_side = [&](std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), 0);
    return is_new ? found->second = middle_of(a, b) : found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t centre = middle_of(a, b, c);
    const std::int32_t ab = middle_of_side(a, b);
    const std::int32_t bc = middle_of_side(b, c);
    const std::int32_t ca = middle_of_side(c, a);
    cut.elements.insert(cut.elements.end(), {{a, ab, centre, ca}, {b, bc, centre, ab}, {c, ca, centre, bc}});
  }
  return cut;
}

/// Points (0, 0, z) whose hash in PointWelder ends in 34 zeros, all of them: that of the splitmix64 finaliser over the
/// bits of x, y and z, which can be run backwards.
inline std::vector<std::array<double, 3>> points_of_one_slot(std::size_t count) {
  constexpr std::uint64_t increment = 0x9e3779b97f4a7c15U;
  constexpr std::array<std::uint64_t, 2> factors{0xbf58476d1ce4e5b9U, 0x94d049bb133111ebU};
  const auto inverse_of = [](std::uint64_t odd) {
    std::uint64_t inverse = odd;  // right in 3 bits; each step doubles them
    for (int step = 0; step < 5; ++step) {
      inverse *= 2 - odd * inverse;
    }
    return inverse;
  };
  const auto unshifted = [](std::uint64_t value, unsigned shift) {
    std::uint64_t result = value;
    for (unsigned done = shift; done < 64; done += shift) {
      result = value ^ (result >> shift);
    }
    return result;
  };
  const auto mixed = [&](std::uint64_t bits) {
    bits = (bits ^ (bits >> 30U)) * factors[0];
    bits = (bits ^ (bits >> 27U)) * factors[1];
    return bits ^ (bits >> 31U);
  };
  const auto unmixed = [&](std::uint64_t bits) {
    bits = unshifted(bits, 31) * inverse_of(factors[1]);
    bits = unshifted(bits, 27) * inverse_of(factors[0]);
    return unshifted(bits, 30);
  };
  const std::uint64_t of_zeros = mixed(mixed(increment) + increment);
  std::vector<std::array<double, 3>> points;
  for (std::uint64_t i = 1; points.size() < count; ++i) {
    const auto z = std::bit_cast<double>(unmixed(i << 34U) - of_zeros - increment);
    if (std::isfinite(z)) {
      points.push_back({0, 0, z});
    }
  }
  return points;
}

}  // namespace hostile_meshes

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

/// Small meshes for tests, made of nothing but seeds: the same on every platform.
namespace test_meshes {

using trismooth::Triangle;
using Point = trismooth::Point2<double>;

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(points.size()); }
  /// As the flat interface takes them.
  std::vector<double> xy() const {
    std::vector<double> flat;
    for (const Point p : points) {
      flat.insert(flat.end(), {p.x, p.y});
    }
    return flat;
  }
  std::span<const std::int32_t> indices() const {
    return {reinterpret_cast<const std::int32_t*>(triangles.data()), 3 * triangles.size()};
  }
};

/// The standard's distributions differ between libraries; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53; }
  std::int32_t below(std::int32_t bound) {
    return static_cast<std::int32_t>(bits_() % static_cast<std::uint64_t>(bound));
  }
  template <class Range>
  void shuffle(Range& range) {
    for (std::size_t i = range.size(); i > 1; --i) {
      std::swap(range[i - 1], range[bits_() % i]);
    }
  }

 private:
  std::mt19937_64 bits_;
};

/// columns x rows vertices on the unit square, row by row, counter-clockwise triangles. Each interior vertex is off its
/// place by up to `jitter` cells along each axis, and diagonals fall at random. Up to about 0.3 all triangles are
/// valid, from 0.5 on some are inverted.
inline Mesh jittered_grid(std::int32_t columns, std::int32_t rows, double jitter, std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (std::int32_t j = 0; j < rows; ++j) {
    for (std::int32_t i = 0; i < columns; ++i) {
      const bool interior = i > 0 && i + 1 < columns && j > 0 && j + 1 < rows;
      const double offset_x = random.between(-jitter, jitter);
      const double offset_y = random.between(-jitter, jitter);
      mesh.points.push_back(
          {(i + (interior ? offset_x : 0)) / (columns - 1), (j + (interior ? offset_y : 0)) / (rows - 1)});
    }
  }
  for (std::int32_t j = 0; j + 1 < rows; ++j) {
    for (std::int32_t i = 0; i + 1 < columns; ++i) {
      const std::int32_t a = j * columns + i;
      const std::int32_t b = a + 1;
      const std::int32_t c = b + columns;
      const std::int32_t d = a + columns;
      if (random.below(2) == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return mesh;
}

/// Vertices far out of place: many inverted triangles, some of them hopelessly so.
inline Mesh tangled(std::int32_t side, std::uint64_t seed) {
  return jittered_grid(side, side, 1.3, seed);
}

/// Right triangles side by side, of these areas, counter-clockwise; negative ones clockwise.
inline Mesh triangles_of_areas(const std::vector<double>& areas) {
  Mesh mesh;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double x = static_cast<double>(i);
    const auto first = static_cast<std::int32_t>(3 * i);
    mesh.points.insert(mesh.points.end(), {{x, 0}, {x + 1, 0}, {x, 2 * areas[i]}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Vertex 0, off the middle of a ring of `size` others.
inline Mesh star(std::int32_t size, std::uint64_t seed = 1) {
  Random random(seed);
  Mesh mesh;
  mesh.points.push_back({0.3, -0.2});
  for (std::int32_t i = 0; i < size; ++i) {
    const double angle = 2 * std::numbers::pi * i / size;
    const double radius = random.between(0.7, 1.3);
    mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    mesh.triangles.push_back({0, i + 1, (i + 1) % size + 1});
  }
  return mesh;
}

/// A ring of `sectors` x `layers` squares, cut into triangles, around a hole. Plain averages pull its vertices over the
/// hole's edge: the domain is not convex.
inline Mesh annulus(std::int32_t sectors, std::int32_t layers, double inner_radius) {
  Mesh mesh;
  for (std::int32_t j = 0; j <= layers; ++j) {
    for (std::int32_t i = 0; i < sectors; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * j) / sectors;
      const double radius = inner_radius + (1 - inner_radius) * j / layers;
      mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      if (j < layers) {
        const std::int32_t a = j * sectors + i;
        const std::int32_t b = j * sectors + (i + 1) % sectors;
        mesh.triangles.insert(mesh.triangles.end(), {{b, a, a + sectors}, {b, a + sectors, b + sectors}});
      }
    }
  }
  return mesh;
}

/// Both meshes as one, `second` moved by `offset`.
inline Mesh together(Mesh first, const Mesh& second, Point offset) {
  const std::int32_t base = first.vertex_count();
  for (const Point p : second.points) {
    first.points.push_back({p.x + offset.x, p.y + offset.y});
  }
  for (const Triangle& t : second.triangles) {
    first.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  return first;
}

/// A band of `length` (3 or more) squares, closed with a half turn: it cannot be oriented.
inline Mesh moebius_band(std::int32_t length) {
  Mesh mesh = jittered_grid(length + 1, 2, 0, 1);
  // The last column is the first one, upside down; the vertices left over are isolated.
  const auto glue = [&](std::int32_t from, std::int32_t to) {
    for (Triangle& t : mesh.triangles) {
      std::ranges::replace(t, from, to);
    }
  };
  glue(length, length + 1);
  glue(2 * length + 1, 0);
  return mesh;
}

/// Two triangles that share vertex 2 and nothing else.
inline Mesh bow_tie() {
  return {{{-1, -1}, {-1, 1}, {0, 0}, {1, -1}, {1, 1}}, {{0, 2, 1}, {2, 3, 4}}};
}

/// Three triangles on the edge from 0 to 1.
inline Mesh three_on_an_edge() {
  return {{{0, 0}, {1, 0}, {0.5, 1}, {0.5, -1}, {0.2, 0.5}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
}

/// The same mesh with vertices and triangles in random order, each triangle beginning at a random corner.
inline Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::int32_t> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  random.shuffle(number);
  Mesh result = mesh;
  for (std::size_t v = 0; v < number.size(); ++v) {
    result.points[number[v]] = mesh.points[v];
  }
  for (Triangle& t : result.triangles) {
    t = {number[t[0]], number[t[1]], number[t[2]]};
    std::rotate(t.begin(), t.begin() + random.below(3), t.end());
  }
  random.shuffle(result.triangles);
  return result;
}

/// The same mesh with a part of its triangles listed the other way round: every `period`-th one.
inline Mesh partly_reversed(Mesh mesh, std::size_t period) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += period) {
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  }
  return mesh;
}

/// Triangles between random vertices: edges and vertices of every kind.
inline std::vector<Triangle> random_soup(std::int32_t vertices, std::int32_t triangles, Random& random) {
  std::vector<Triangle> soup;
  while (static_cast<std::int32_t>(soup.size()) < triangles) {
    const Triangle t{random.below(vertices), random.below(vertices), random.below(vertices)};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      soup.push_back(t);
    }
  }
  return soup;
}

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Meshes of every kind that is smoothed, small, all listed counter-clockwise.
inline std::vector<NamedMesh> zoo() {
  return {{"grid", jittered_grid(12, 9, 0.3, 1)},
          {"shuffled grid", shuffled(jittered_grid(9, 14, 0.45, 2), 3)},
          {"tangled", shuffled(tangled(14, 4), 5)},
          {"hopelessly tangled", shuffled(jittered_grid(10, 10, 4, 6), 7)},
          {"annulus", shuffled(annulus(11, 6, 0.5), 8)},
          {"two components", shuffled(together(tangled(8, 9), annulus(9, 4, 0.3), {5, -3}), 10)},
          {"star of three", star(3)},
          {"star of twenty", shuffled(star(20), 11)},
          {"no free vertex", three_on_an_edge()}};
}

}  // namespace test_meshes

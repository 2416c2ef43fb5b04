// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/triangle_view.h"

/// Meshes of the kinds that a halfedge mesh has to cope with, in the xy plane.
namespace planar_samples {

struct Sample {
  std::string name;
  std::vector<double> xyz;
  std::vector<trismooth::Triangle> triangles;
  bool manifold = true;  ///< no edge with three triangles, no vertex with two fans

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(xyz.size() / 3); }
  std::vector<double> xy() const {
    std::vector<double> result;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      result.insert(result.end(), {xyz[i], xyz[i + 1]});
    }
    return result;
  }
};

/// n x n squares cut by random diagonals, counter-clockwise; inner vertices jittered by up to `jitter` edge lengths.
inline Sample grid(std::int32_t n, double jitter, std::mt19937_64& random) {
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  Sample sample{"grid", {}, {}, true};
  for (std::int32_t row = 0; row <= n; ++row) {
    for (std::int32_t column = 0; column <= n; ++column) {
      const bool inner = row > 0 && row < n && column > 0 && column < n;
      sample.xyz.insert(sample.xyz.end(),
                        {column + (inner ? shift(random) : 0.0), row + (inner ? shift(random) : 0.0), 0.25});
      if (row < n && column < n) {
        const std::int32_t v = row * (n + 1) + column;
        if (random() % 2 == 0) {
          sample.triangles.insert(sample.triangles.end(), {{v, v + 1, v + n + 2}, {v, v + n + 2, v + n + 1}});
        } else {
          sample.triangles.insert(sample.triangles.end(), {{v, v + 1, v + n + 1}, {v + 1, v + n + 2, v + n + 1}});
        }
      }
    }
  }
  return sample;
}

/// A grid bent to a ring: two boundary loops.
inline Sample annulus(std::int32_t around, std::int32_t layers, std::mt19937_64& random) {
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  Sample sample{"annulus", {}, {}, true};
  for (std::int32_t layer = 0; layer <= layers; ++layer) {
    for (std::int32_t i = 0; i < around; ++i) {
      const bool inner = layer > 0 && layer < layers;
      const double angle = 2 * std::numbers::pi * (i + (inner ? shift(random) : 0.0)) / around;
      const double radius = around + layer + (inner ? shift(random) : 0.0);
      sample.xyz.insert(sample.xyz.end(), {radius * std::cos(angle), radius * std::sin(angle), 0});
      if (layer < layers) {
        const std::int32_t v = layer * around + i;
        const std::int32_t next = layer * around + (i + 1) % around;
        sample.triangles.insert(sample.triangles.end(), {{v, v + around, next + around}, {v, next + around, next}});
      }
    }
  }
  return sample;
}

/// Both meshes, apart from each other, with an isolated vertex between.
inline Sample together(Sample first, const Sample& second) {
  first.xyz.insert(first.xyz.end(), {-100, 0, first.xyz[2]});
  const std::int32_t offset = first.vertex_count();
  for (std::size_t i = 0; i < second.xyz.size(); i += 3) {
    first.xyz.insert(first.xyz.end(), {second.xyz[i] + 200, second.xyz[i + 1], first.xyz[2]});
  }
  for (const auto& [a, b, c] : second.triangles) {
    first.triangles.push_back({a + offset, b + offset, c + offset});
  }
  first.manifold = first.manifold && second.manifold;
  first.name += " and " + second.name;
  return first;
}

/// A grid without a third of its triangles: holes of all shapes, many vertices with two fans or more.
inline Sample sieve(std::int32_t n, std::mt19937_64& random) {
  Sample sample = grid(n, 0.3, random);
  std::erase_if(sample.triangles, [&](const auto&) { return random() % 3 == 0; });
  sample.name = "sieve";
  sample.manifold = false;
  return sample;
}

/// A grid where further triangles stand on some of the edges: edges with three triangles.
inline Sample finned(std::int32_t n, std::mt19937_64& random) {
  Sample sample = grid(n, 0.3, random);
  const std::size_t count = sample.triangles.size();
  for (std::size_t t = 0; t < count; t += 7) {
    const auto [a, b, c] = sample.triangles[t];
    sample.triangles.push_back({b, a, sample.vertex_count()});
    sample.xyz.insert(sample.xyz.end(), {sample.xyz[3 * c] + 0.125, sample.xyz[3 * c + 1] - 0.25, 0.25});
  }
  sample.name = "finned";
  sample.manifold = false;
  return sample;
}

inline void list_clockwise(Sample& sample) {
  for (trismooth::Triangle& triangle : sample.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
}

/// The same mesh with its vertices and triangles in random order, and corners beginning anywhere.
inline Sample shuffled(Sample sample, std::mt19937_64& random) {
  std::vector<std::int32_t> number(sample.xyz.size() / 3);
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  const std::vector<double> old = sample.xyz;
  for (std::size_t v = 0; v < number.size(); ++v) {
    std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, sample.xyz.begin() + 3 * number[v]);
  }
  std::shuffle(sample.triangles.begin(), sample.triangles.end(), random);
  for (trismooth::Triangle& triangle : sample.triangles) {
    for (std::int32_t& corner : triangle) {
      corner = number[static_cast<std::size_t>(corner)];
    }
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(random() % 3), triangle.end());
  }
  return sample;
}

/// The same mesh with every other triangle, at random, listed clockwise.
inline Sample mixed(Sample sample, std::mt19937_64& random) {
  for (trismooth::Triangle& triangle : sample.triangles) {
    if (random() % 2 == 0) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  sample.name += ", mixed orientation";
  return sample;
}

/// Manifold meshes, listed counter-clockwise but for a component of the last.
inline std::vector<Sample> manifold_samples() {
  std::mt19937_64 random(11);
  Sample clockwise = annulus(9, 3, random);
  list_clockwise(clockwise);
  return {{"one triangle", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {{2, 0, 1}}, true},
          grid(1, 0, random),
          grid(2, 0.3, random),
          grid(15, 0.4, random),
          shuffled(grid(15, 0.4, random), random),
          shuffled(annulus(20, 4, random), random),
          shuffled(together(grid(6, 0.3, random), annulus(12, 5, random)), random),
          shuffled(together(grid(8, 0.3, random), clockwise), random)};
}

/// All kinds.
inline std::vector<Sample> samples() {
  std::mt19937_64 random(12);
  std::vector<Sample> all = manifold_samples();
  all.push_back({"nothing", {}, {}, true});
  all.push_back({"points alone", {0, 0, 0, 1, 0, 0}, {}, true});
  all.push_back({"bow tie", {0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0}, {{0, 1, 2}, {3, 4, 0}}, false});
  all.push_back({"three triangles on an edge",
                 {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0.5, 2, 0},
                 {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},
                 false});
  all.push_back(shuffled(sieve(15, random), random));
  all.push_back(shuffled(finned(10, random), random));
  all.push_back(shuffled(together(sieve(8, random), finned(6, random)), random));
  for (std::size_t i = 0, count = all.size(); i < count; ++i) {
    all.push_back(mixed(all[i], random));
  }
  return all;
}

}  // namespace planar_samples

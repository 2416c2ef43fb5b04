// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/test_meshes.h"

/// Rectangles with a boundary layer on one side, as mesh generators for flows make them, for tests and benchmarks.
namespace layered_meshes {

using test_meshes::Mesh;
using test_meshes::Point;
using test_meshes::Random;

struct Layers {
  std::int32_t columns = 0;       ///< vertices along the wall
  std::vector<double> heights{};  ///< of the rows of triangles in the layer, from the wall; columns are 1 wide
  std::int32_t rows_above = 0;    ///< rows of triangles about as high as wide, on top of it
  double jitter = 0;              ///< by which vertices above the layer are off their places, in widths
  double layer_jitter = 0;        ///< by which those in the layer are, in widths along it and in heights of their rows
};

/// Row by row from the wall, which is y = 0; columns of uneven width, diagonals at random.
inline Mesh rectangle(const Layers& layers, Random& random) {
  std::vector<double> x(static_cast<std::size_t>(layers.columns), 0);
  for (std::size_t i = 1; i < x.size(); ++i) {
    x[i] = x[i - 1] + random.between(0.9, 1.1);
  }
  std::vector<double> y{0};
  for (const double height : layers.heights) {
    y.push_back(y.back() + height);
  }
  for (std::int32_t row = 0; row < layers.rows_above; ++row) {
    y.push_back(y.back() + 1);
  }
  const auto rows = static_cast<std::int32_t>(y.size());
  const auto in_layer = static_cast<std::int32_t>(layers.heights.size());
  Mesh mesh;
  for (std::int32_t j = 0; j < rows; ++j) {
    for (std::int32_t i = 0; i < layers.columns; ++i) {
      const bool is_inner = i > 0 && i + 1 < layers.columns && j > 0 && j + 1 < rows;
      const double by = j <= in_layer ? layers.layer_jitter : layers.jitter;
      const double up = j <= in_layer ? by * layers.heights[static_cast<std::size_t>(std::min(j, in_layer - 1))] : by;
      const Point off{random.between(-by, by), random.between(-up, up)};
      mesh.points.push_back({x[static_cast<std::size_t>(i)] + (is_inner ? off.x : 0),
                             y[static_cast<std::size_t>(j)] + (is_inner ? off.y : 0)});
    }
  }
  for (std::int32_t j = 0; j + 1 < rows; ++j) {
    for (std::int32_t i = 0; i + 1 < layers.columns; ++i) {
      const std::int32_t a = j * layers.columns + i;
      const std::int32_t b = a + 1;
      const std::int32_t c = b + layers.columns;
      const std::int32_t d = a + layers.columns;
      if (random.below(2) == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return mesh;
}

/// Heights that grow from `first` by `growth` as long as columns are at least 5 times as wide.
inline std::vector<double> growing(double first, double growth, std::int32_t most) {
  std::vector<double> heights;
  for (double height = first; height <= 0.2 && std::ssize(heights) < most; height *= growth) {
    heights.push_back(height);
  }
  return heights;
}

}  // namespace layered_meshes

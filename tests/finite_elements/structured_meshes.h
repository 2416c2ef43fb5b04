// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "finite_elements/linear_triangles.h"

namespace structured {

/// The unit square of n x n squares, each cut into two triangles.
inline fem::Mesh square(int n) {
  fem::Mesh mesh;
  mesh.points.resize(2, (n + 1) * (n + 1));
  mesh.triangles.resize(3, 2 * n * n);
  int triangle = 0;
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const int v = row * (n + 1) + column;
      mesh.points.col(v) << static_cast<double>(column) / n, static_cast<double>(row) / n;
      if (row < n && column < n) {
        mesh.triangles.col(triangle++) << v, v + 1, v + n + 2;
        mesh.triangles.col(triangle++) << v, v + n + 2, v + n + 1;
      }
    }
  }
  return mesh;
}

/// The square with its inner vertices displaced by up to `part` of the spacing in x and y, always the same. Up to a
/// fifth, no triangle is inverted. Every third triangle is listed the other way round.
inline fem::Mesh displaced_square(int n, double part) {
  fem::Mesh mesh = square(n);
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8) / (1 << 23) - 1;
  };
  for (int row = 1; row < n; ++row) {
    for (int column = 1; column < n; ++column) {
      mesh.points.col(row * (n + 1) + column) += part / n * Eigen::Vector2d(random(), random());
    }
  }
  for (Eigen::Index triangle = 0; triangle < mesh.triangles.cols(); triangle += 3) {
    mesh.triangles.col(triangle).tail<2>().reverseInPlace();
  }
  return mesh;
}

/// The ring between the circles of radius 1 and 3 around (0, 0): n steps outwards, 4 n around.
inline fem::Mesh ring(int n) {
  fem::Mesh mesh;
  const int around = 4 * n;
  mesh.points.resize(2, around * (n + 1));
  mesh.triangles.resize(3, 2 * around * n);
  int triangle = 0;
  for (int step = 0; step <= n; ++step) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.points.col(step * around + i) = (1 + 2.0 * step / n) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (step < n) {
        const int a = step * around + i;
        const int b = step * around + (i + 1) % around;
        mesh.triangles.col(triangle++) << a, b, b + around;
        mesh.triangles.col(triangle++) << a, b + around, a + around;
      }
    }
  }
  return mesh;
}

}  // namespace structured

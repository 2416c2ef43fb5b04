// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

/// Meshes of quadrilaterals and triangles, and what a user would say of them: by plain loops over their elements.
namespace mixed_meshes {

using Point = std::array<double, 2>;
using Element = std::array<std::int32_t, 4>;  ///< the last corner of a triangle is -1

struct MixedMesh {
  std::vector<Point> points;
  std::vector<Element> elements;

  MixedMesh() = default;

  /// A grid of squares, about so many thirds of which are two triangles, with points moved by up to `jitter`.
  MixedMesh(std::int32_t columns, std::int32_t rows, double jitter, std::uint64_t seed, std::uint64_t thirds = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> off(-jitter, jitter);
    for (std::int32_t row = 0; row <= rows; ++row) {
      for (std::int32_t column = 0; column <= columns; ++column) {
        const double x = column + off(random);
        points.push_back({x, row + off(random)});
      }
    }
    for (std::int32_t row = 0; row < rows; ++row) {
      for (std::int32_t column = 0; column < columns; ++column) {
        const std::int32_t a = row * (columns + 1) + column;
        const std::int32_t c = a + columns + 2;
        if (random() % 3 < thirds) {
          elements.push_back({a, a + 1, c, -1});
          elements.push_back({a, c, c - 1, -1});
        } else {
          elements.push_back({a, a + 1, c, c - 1});
        }
      }
    }
  }

  bool is_triangle(std::size_t e) const { return elements[e][3] < 0; }
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(points.size()); }
  std::vector<std::int32_t> corners(std::size_t e) const {
    return {elements[e].begin(), elements[e].begin() + (is_triangle(e) ? 3 : 4)};
  }
  std::vector<double> xy() const {
    std::vector<double> numbers;
    for (const auto& [x, y] : points) {
      numbers.insert(numbers.end(), {x, y});
    }
    return numbers;
  }

  /// The elements in another order.
  MixedMesh in_another_order(std::uint64_t seed) const {
    MixedMesh listed = *this;
    std::mt19937_64 random(seed);
    std::shuffle(listed.elements.begin(), listed.elements.end(), random);
    return listed;
  }
  /// The elements listed from other corners on; with `turns` every third the other way round.
  MixedMesh listed_from_other_corners(std::uint64_t seed, bool turns) const {
    MixedMesh listed = *this;
    std::mt19937_64 random(seed);
    for (Element& element : listed.elements) {
      const auto end = element.begin() + (element[3] < 0 ? 3 : 4);
      std::rotate(element.begin(), element.begin() + static_cast<std::ptrdiff_t>(random() % 3), end);
      if (turns && random() % 3 == 0) {
        std::reverse(element.begin(), end);
      }
    }
    return listed;
  }
};

/// The shape of an element by its definition, at the corners `xy`: from the products of its sides.
inline double shape_by_definition(const MixedMesh& mesh, std::size_t e, const std::vector<double>& xy) {
  const std::vector<std::int32_t> corners = mesh.corners(e);
  const std::size_t count = corners.size();
  const auto side = [&](std::size_t from, std::size_t to) {
    const auto a = static_cast<std::size_t>(corners[from % count]);
    const auto b = static_cast<std::size_t>(corners[to % count]);
    return Point{xy[2 * b] - xy[2 * a], xy[2 * b + 1] - xy[2 * a + 1]};
  };
  const auto squared = [](Point s) { return s[0] * s[0] + s[1] * s[1]; };
  if (count == 3) {
    const Point out = side(0, 1);
    const Point back = side(0, 2);
    const double sum = squared(out) + squared(side(1, 2)) + squared(back);
    return sum == 0 ? 0 : 2 * std::numbers::sqrt3 * (out[0] * back[1] - out[1] * back[0]) / sum;
  }
  double smallest = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point out = side(i, i + 1);
    const Point back = side(i, i + 3);
    const double both = squared(out) + squared(back);
    smallest = std::min(smallest, both == 0 ? 0 : 2 * (out[0] * back[1] - out[1] * back[0]) / both);
  }
  return smallest;
}

/// A grid of both kinds or of one, some with holes, bent and stretched, with inverted elements or without; numbered at
/// random, counter-clockwise but for what is inverted.
inline MixedMesh random_mesh(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto columns = static_cast<std::int32_t>(3 + random() % 9);
  const auto rows = static_cast<std::int32_t>(3 + random() % 9);
  const std::array jitters{0.1, 0.25, 0.45, 0.6};
  MixedMesh mesh(columns, rows, jitters[random() % 4], random(), random() % 4);
  if (random() % 2 == 0) {
    std::erase_if(mesh.elements, [&](const Element&) { return random() % 12 == 0; });
  }
  // Bent and stretched.
  const double bend = static_cast<double>(random() % 100) / 400;
  const double stretch = random() % 4 == 0 ? 8 : 1;
  for (auto& [x, y] : mesh.points) {
    y += bend * std::sin(x);
    x *= stretch;
  }
  std::vector<std::int32_t> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  std::vector<Point> points(mesh.points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[static_cast<std::size_t>(number[v])] = mesh.points[v];
  }
  mesh.points = std::move(points);
  for (Element& element : mesh.elements) {
    for (std::int32_t& v : element) {
      v = v < 0 ? v : number[static_cast<std::size_t>(v)];
    }
  }
  return mesh.in_another_order(random()).listed_from_other_corners(random(), false);
}

}  // namespace mixed_meshes

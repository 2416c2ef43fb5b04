// SPDX-License-Identifier: BSD-3-Clause
// Vertices that slide as one: periodic sides, faces of cracks.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/sliding_meshes.h"

namespace trismooth::sliding_together_test {

using namespace sliding_meshes;

constexpr std::int32_t side = 12;

Mesh square_with_uneven_sides(std::uint64_t seed) {
  return uneven_square(side, 0.4, seed);
}

/// A strip of `columns` x 4 vertices on (0, 1) x (0, 3 / columns), those of each row unevenly spaced, `place` maps it.
/// Its first row is its lower side.
template <class Place>
Mesh strip(std::int32_t columns, std::uint64_t seed, const Place& place) {
  test_meshes::Random random(seed);
  std::vector<double> along;
  for (std::int32_t i = 0; i < columns; ++i) {
    const bool is_end = i == 0 || i + 1 == columns;
    along.push_back((i + (is_end ? 0 : random.between(-0.3, 0.3))) / (columns - 1));
  }
  Mesh mesh;
  for (std::int32_t j = 0; j < 4; ++j) {
    for (std::int32_t i = 0; i < columns; ++i) {
      mesh.points.push_back(place(Point{along[i], static_cast<double>(j) / columns}));
      if (i + 1 < columns && j < 3) {
        const std::int32_t a = j * columns + i;
        mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + columns + 1}, {a, a + columns + 1, a + columns}});
      }
    }
  }
  return mesh;
}

/// How far p is from the nearest edge of a row of points.
double distance_to(std::span<const Point> row, Point p) {
  double nearest = std::hypot(p.x - row[0].x, p.y - row[0].y);
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    const Point a = row[i];
    const Point way{row[i + 1].x - a.x, row[i + 1].y - a.y};
    const double part =
        std::clamp(((p.x - a.x) * way.x + (p.y - a.y) * way.y) / (way.x * way.x + way.y * way.y), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(p.x - a.x - part * way.x, p.y - a.y - part * way.y));
  }
  return nearest;
}

TEST_CASE("linked sides stay equal to the bit, and slide") {
  Mesh mesh = square_with_uneven_sides(6);
  std::vector<std::int32_t> links;
  for (std::int32_t i = 0; i < side; ++i) {
    mesh.points[i * side + side - 1].y = mesh.points[i * side].y;  // right as left
    mesh.points[(side - 1) * side + i].x = mesh.points[i].x;       // top as bottom
    links.insert(links.end(), {i * side, i * side + side - 1, (side - 1) * side + i, i});
  }
  for (const Method method : trismooth::values_of<Method>()) {
    Constraints constraints;
    constraints.slide.along = Slide::straight;
    constraints.slide.links = links;
    const Smoothed found = smoothed(mesh, constraints, method);
    CHECK(found.result.sliding->chains == 2);
    CHECK(found.result.sliding->vertices == 4 * (side - 2));
    CHECK(found.result.sliding->slid > side);
    for (std::int32_t i = 0; i < side; ++i) {
      CHECK(same_bits(found.at(i * side).y, found.at(i * side + side - 1).y));
      CHECK(same_bits(found.at(i).x, found.at((side - 1) * side + i).x));
      CHECK(found.at(i * side).x == 0);
      CHECK(found.at(i * side + side - 1).x == 1);
    }
  }
}

TEST_CASE("sides that are linked in part stay, and so does what a link holds inside") {
  const Mesh mesh = square_with_uneven_sides(7);
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  const std::int32_t inside = 5 * side + 5;
  const std::vector<std::int32_t> links{3 * side, 3 * side + side - 1, inside, inside + 2};
  constraints.slide.links = links;
  const Smoothed found = smoothed(mesh, constraints);
  for (const std::int32_t v : links) {
    CHECK(is_at(found, mesh, v));
  }
}

TEST_CASE("the faces of a crack slide only if asked to, and then together") {
  // A square whose middle row is there twice, between columns 2 and side - 3, each face with its own triangles.
  Mesh mesh = square_with_uneven_sides(9);
  const std::int32_t row = 6;
  for (std::int32_t i = 0; i < side; ++i) {
    mesh.points[row * side + i].y = 0.5;
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> faces;
  for (std::int32_t i = 3; i < side - 3; ++i) {
    const std::int32_t below = row * side + i;
    const std::int32_t above = mesh.vertex_count();
    mesh.points.push_back(mesh.points[below]);
    faces.emplace_back(below, above);
    for (Triangle& triangle : mesh.triangles) {
      if (std::ranges::all_of(triangle, [&](std::int32_t v) { return v >= row * side; })) {
        std::ranges::replace(triangle, below, above);
      }
    }
  }
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  const Smoothed apart = smoothed(mesh, constraints);
  constraints.slide.coincident = true;
  const Smoothed together = smoothed(mesh, constraints);
  int slid = 0;
  for (const auto& [below, above] : faces) {
    CHECK(is_at(apart, mesh, below));
    CHECK(is_at(apart, mesh, above));
    CHECK(together.at(below) == together.at(above));
    CHECK(together.at(below).y == 0.5);
    slid += is_at(together, mesh, below) ? 0 : 1;
  }
  CHECK(slid > 0);
}

TEST_CASE("linked lines whose ends are not linked stay") {
  const Mesh mesh = square_with_uneven_sides(10);
  std::vector<std::int32_t> links;
  for (std::int32_t i = 1; i + 1 < side; ++i) {
    links.insert(links.end(), {i * side, i * side + side - 1});
  }
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  constraints.slide.links = links;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK(found.result.sliding->chains == 2);
  for (const std::int32_t v : links) {
    CHECK(is_at(found, mesh, v));
  }
}

TEST_CASE("each of two linked lines deviates no further than its own edges allow") {
  // A straight side of a strip, and a small arc with as many vertices. What cuts corners of the arc cuts none of the
  // side.
  constexpr std::int32_t columns = 30;
  Mesh mesh = strip(columns, 11, [](Point p) { return Point{10 * p.x, 10 * p.y}; });
  const std::int32_t arc = add(mesh, strip(columns, 12, [](Point p) {
                                 const double angle = std::numbers::pi * p.x;
                                 const double radius = 1 - p.y;
                                 return Point{-3 - radius * std::cos(angle), radius * std::sin(angle)};
                               }));
  std::vector<std::int32_t> links;
  for (std::int32_t i = 0; i < columns; ++i) {
    links.insert(links.end(), {i, arc + i});
  }
  Constraints constraints;
  constraints.slide.along = Slide::curves;
  constraints.slide.deviation = 0.01;
  constraints.slide.links = links;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK_FALSE(is_at(found, mesh, arc + columns / 2));
  CHECK(found.result.sliding->relative_deviation <= 0.01);
  std::vector<Point> now;
  for (std::int32_t i = 0; i < columns; ++i) {
    now.push_back(found.at(arc + i));
  }
  for (std::int32_t i = 1; i + 1 < columns; ++i) {
    const auto length = [&](std::int32_t a, std::int32_t b) {
      return std::hypot(mesh.points[arc + a].x - mesh.points[arc + b].x,
                        mesh.points[arc + a].y - mesh.points[arc + b].y);
    };
    CAPTURE(i);
    CHECK(distance_to(now, mesh.points[arc + i]) <= 0.01 * std::min(length(i - 1, i), length(i, i + 1)) + 1e-14);
  }
}

TEST_CASE("what lies in the same place as a vertex that something else holds stays") {
  // Two squares that share a side but no vertex, the lower one's vertices there held by name.
  Mesh mesh = square_with_uneven_sides(13);
  const Mesh lower = square_with_uneven_sides(14);
  const std::int32_t first = add(mesh, lower);
  std::vector<std::int32_t> held;
  for (std::int32_t v = first; v < mesh.vertex_count(); ++v) {
    mesh.points[v].y -= 1;
  }
  for (std::int32_t i = 0; i < side; ++i) {
    const std::int32_t below = first + (side - 1) * side + i;
    mesh.points[below] = mesh.points[i];
    held.push_back(below);
  }
  Constraints constraints;
  constraints.fixed_ids = held;
  constraints.slide.along = Slide::straight;
  for (const bool coincident : {false, true}) {
    constraints.slide.coincident = coincident;
    const Smoothed found = smoothed(mesh, constraints);
    CHECK(found.result.sliding->slid > side);
    for (std::int32_t i = 0; i < side; ++i) {
      CHECK(is_at(found, mesh, i));
      CHECK(is_at(found, mesh, held[i]));
    }
  }
}

}  // namespace trismooth::sliding_together_test

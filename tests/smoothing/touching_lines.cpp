// SPDX-License-Identifier: BSD-3-Clause
// Lines that touch without sharing vertices: the sides of two parts that are there twice, nearly in the same place, or
// with vertices of their own. What nobody looks at alone must not part or run into each other.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "trismooth/smoothing/slide/slide_chains.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/sliding_meshes.h"

namespace trismooth::touching_lines_test {

using namespace sliding_meshes;

constexpr std::int32_t side = 12;

Constraints sliding(Slide along, double deviation = 1e-3) {
  Constraints constraints;
  constraints.slide.along = along;
  constraints.slide.deviation = deviation;
  return constraints;
}

double twice_area(const Smoothed& found, const Triangle& t) {
  const Point a = found.at(t[0]);
  const Point b = found.at(t[1]);
  const Point c = found.at(t[2]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Two rings that meet at a polygon, which is the outer side of the inner one, with `parts` of its vertices on each of
/// the outer one's edges there: at the corners as well, unless `shift` says by which part of an edge they are off.
struct TwoRings {
  static constexpr std::int32_t around = 24;

  Mesh mesh;
  std::int32_t parts;
  std::int32_t inner;                     ///< the first vertex of the inner ring
  std::vector<std::int32_t> on_polygon;   ///< all vertices there
  std::vector<std::int32_t> on_outlines;  ///< and on the other sides

  TwoRings(std::int32_t parts_of_an_edge, double shift) : parts(parts_of_an_edge) {
    const auto corner = [](std::int32_t i) {
      const double angle = 2 * std::numbers::pi * (i + 0.3 * (i % 3) / 3) / around;
      return Point{std::cos(angle), std::sin(angle)};
    };
    const auto along = [&](std::int32_t i) {
      // Unevenly, so that they would slide.
      const double part = (i % parts + shift + (i % parts == 0 ? 0 : 0.25 * (i % 2))) / parts;
      const Point a = corner(i / parts);
      const Point b = corner((i / parts + 1) % around);
      return Point{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
    };
    const auto add_ring = [&](std::int32_t count, const auto& place, double first, double last) {
      const std::int32_t start = mesh.vertex_count();
      constexpr std::int32_t rows = 5;
      for (std::int32_t r = 0; r < rows; ++r) {
        const double radius = first + (last - first) * r / (rows - 1);
        for (std::int32_t i = 0; i < count; ++i) {
          const Point p = place(i);
          mesh.points.push_back({radius * p.x, radius * p.y});
          if (radius == 1) {
            on_polygon.push_back(mesh.vertex_count() - 1);
          } else if (r == 0 || r + 1 == rows) {
            on_outlines.push_back(mesh.vertex_count() - 1);
          }
        }
      }
      for (std::int32_t r = 0; r + 1 < rows; ++r) {
        for (std::int32_t i = 0; i < count; ++i) {
          const std::int32_t a = start + r * count + i;
          const std::int32_t b = start + r * count + (i + 1) % count;
          mesh.triangles.insert(mesh.triangles.end(), {{a, a + count, b}, {b, a + count, b + count}});
        }
      }
      return start;
    };
    add_ring(around, corner, 1, 2);
    inner = add_ring(around * parts, along, 0.5, 1);
  }
};

TEST_CASE("sides that nearly coincide stay, as those that do, and are counted") {
  for (const double gap : {0.0, 1e-10, 1e-6}) {
    const TwoSquares two(side, gap);
    for (const Slide along : {Slide::straight, Slide::curves}) {
      const Smoothed found = smoothed(two.mesh, sliding(along));
      CAPTURE(gap, to_string(along));
      CHECK(found.result.sliding->slid > side);
      // (On sides that are not straight to rounding all are corners.)
      CHECK(found.result.sliding->in_same_place == (gap > 0 && along == Slide::straight ? 1 : 2) * (side - 2));
      CHECK(found.result.sliding->at_edges == 0);
      for (std::int32_t j = 0; j < side; ++j) {
        CHECK(is_at(found, two.mesh, two.left_of(j)));
        CHECK(is_at(found, two.mesh, two.right_of(j)));
      }
    }
  }
}

TEST_CASE("sides that nearly coincide slide as one if asked to, as far apart as they were") {
  for (const double gap : {1e-10, 1e-6}) {
    const TwoSquares two(side, gap);
    double widest = 0;
    for (std::int32_t j = 0; j < side; ++j) {
      widest = std::max(widest, std::hypot(two.mesh.points[two.right_of(j)].x - two.mesh.points[two.left_of(j)].x,
                                           two.mesh.points[two.right_of(j)].y - two.mesh.points[two.left_of(j)].y));
    }
    for (const Method method : {Method::mean_ratio, Method::laplacian, Method::weighted}) {
      Constraints constraints = sliding(Slide::curves);
      constraints.slide.coincident = true;
      const Smoothed found = smoothed(two.mesh, constraints, method);
      CAPTURE(gap, to_string(method));
      CHECK(found.result.sliding->in_same_place == 0);
      int slid = 0;
      for (std::int32_t j = 0; j < side; ++j) {
        const Point left = found.at(two.left_of(j));
        const Point right = found.at(two.right_of(j));
        CHECK(right.x >= left.x);
        CHECK(std::hypot(right.x - left.x, right.y - left.y) <= widest + 1e-15);
        slid += is_at(found, two.mesh, two.left_of(j)) ? 0 : 1;
        CHECK(is_at(found, two.mesh, two.left_of(j)) == is_at(found, two.mesh, two.right_of(j)));
      }
      CHECK(slid > side / 3);
      for (const Triangle& triangle : two.mesh.triangles) {
        CHECK(twice_area(found, triangle) > 0);
      }
    }
  }
}

TEST_CASE("sides that were to slide together and cannot are counted") {
  // One vertex of a side is held by name, and with it the one in its place.
  TwoSquares two(side, 1e-10);
  Constraints constraints = sliding(Slide::curves);
  constraints.slide.coincident = true;
  const std::vector<std::int32_t> held{two.left_of(5)};
  constraints.fixed_ids = held;
  const Smoothed found = smoothed(two.mesh, constraints);
  CHECK(is_at(found, two.mesh, two.right_of(5)));
  CHECK(found.result.sliding->in_same_place == 1);
  CHECK(found.result.sliding->at_edges == 0);
}

TEST_CASE("sides that nearly coincide stay where splines would bring them farther apart") {
  for (const double gap : {0.0, 1e-10}) {
    const TwoSquares two(side, gap);
    Constraints constraints = sliding(Slide::curves);
    constraints.slide.coincident = true;
    constraints.slide.curve = SlideCurve::spline;
    const Smoothed found = smoothed(two.mesh, constraints);
    CHECK(found.result.sliding->in_same_place == (gap > 0 ? 2 * (side - 2) : 0));
    int slid = 0;
    for (std::int32_t j = 0; j < side; ++j) {
      slid += is_at(found, two.mesh, two.left_of(j)) ? 0 : 1;
    }
    CHECK((slid > 0) == (gap == 0));
  }
}

TEST_CASE("sides whose vertices lie within each other's edges stay, the ends of the edges as well") {
  for (const double shift : {0.0, 0.15}) {
    const TwoRings two(4, shift);
    for (const bool coincident : {false, true}) {
      Constraints constraints = sliding(Slide::curves, 0.05);
      constraints.slide.corner_angle = 60;
      constraints.slide.coincident = coincident;
      const Smoothed found = smoothed(two.mesh, constraints);
      CAPTURE(shift, coincident);
      for (const std::int32_t v : two.on_polygon) {
        CHECK(is_at(found, two.mesh, v));
      }
      CHECK(std::ranges::any_of(two.on_outlines, [&](std::int32_t v) { return !is_at(found, two.mesh, v); }));
      const std::int64_t in_same_place = shift > 0 || coincident ? 0 : 2 * TwoRings::around;
      CHECK(found.result.sliding->in_same_place == in_same_place);
      CHECK(found.result.sliding->at_edges == std::ssize(two.on_polygon) - in_same_place);
    }
  }
}

TEST_CASE("the faces of a crack whose vertices differ stay, up to its tip") {
  // Two rows of triangles over and under a slit that is open on the right, with a vertex of their own on each face.
  Mesh mesh = uneven_square(side, 0.2, 8);
  const std::int32_t row = side / 2;
  for (std::int32_t i = 0; i < side; ++i) {
    mesh.points[row * side + i].y = 0.5;
  }
  std::vector<std::int32_t> faces;
  for (std::int32_t i = 4; i < side; ++i) {
    const std::int32_t below = row * side + i;
    const std::int32_t above = mesh.vertex_count();
    mesh.points.push_back(mesh.points[below]);
    mesh.points.back().x += i + 1 < side ? 0.3 / side : 0;
    faces.insert(faces.end(), {below, above});
    for (Triangle& triangle : mesh.triangles) {
      if (std::ranges::all_of(triangle, [&](std::int32_t v) { return v >= row * side; })) {
        std::ranges::replace(triangle, below, above);
      }
    }
  }
  const Smoothed found = smoothed(mesh, sliding(Slide::straight));
  for (const std::int32_t v : faces) {
    CHECK(is_at(found, mesh, v));
  }
  CHECK(found.result.sliding->at_edges == std::ssize(faces) - 2);
  CHECK(found.result.sliding->slid > 0);
}

TEST_CASE("neither sides of thin layers nor corners of graded meshes touch") {
  // Squares flattened to a hundred thousandth of their length, and a square of which two sides have edges that get
  // finer and finer.
  for (const double flatness : {1.0, 1e-3, 1e-5}) {
    Mesh mesh = uneven_square(side, 0.3, 17);
    Mesh graded = uneven_square(side, 0.3, 18);
    for (auto& p : mesh.points) {
      p.y *= flatness / side;
    }
    for (auto& p : graded.points) {
      p = {std::expm1(9 * p.x) / std::expm1(9.0) + 0.3 * p.y * std::expm1(15 * p.y) / std::expm1(15.0),
           3 + std::expm1(15 * p.y) / std::expm1(15.0)};
    }
    add(mesh, graded);
    const Smoothed found = smoothed(mesh, sliding(Slide::curves));
    CAPTURE(flatness);
    CHECK(found.result.sliding->vertices > 4 * side);
    CHECK(found.result.sliding->in_same_place == 0);
    CHECK(found.result.sliding->at_edges == 0);
  }
}

TEST_CASE("lines touch whatever the order of vertices, and however long their edges are") {
  // Small squares in a row along a large one's side, of sizes from 1 to 1e-9.
  Mesh mesh = uneven_square(2, 0, 1);
  std::vector<std::int32_t> beside;
  double place = 0.01;
  for (double size = 0.05; size > 1e-9; size /= 4) {
    Mesh small = uneven_square(4, 0.3, 2);
    for (auto& p : small.points) {
      p = {place + size * p.x, -size * p.y};
    }
    const std::int32_t first = add(mesh, small);
    beside.insert(beside.end(), {first + 1, first + 2});
    place += 2 * size;
  }
  Constraints constraints = sliding(Slide::straight);
  for (const bool is_reversed : {false, true}) {
    Mesh listed = mesh;
    const std::int32_t last = mesh.vertex_count() - 1;
    const auto number = [&](std::int32_t v) { return is_reversed ? last - v : v; };
    for (std::int32_t v = 0; v <= last; ++v) {
      listed.points[number(v)] = mesh.points[v];
    }
    for (Triangle& triangle : listed.triangles) {
      triangle = {number(triangle[0]), number(triangle[1]), number(triangle[2])};
    }
    const Smoothed found = smoothed(listed, constraints);
    for (const std::int32_t v : beside) {
      CHECK(is_at(found, listed, number(v)));
    }
    CHECK(found.result.sliding->at_edges == std::ssize(beside));
    CHECK(found.result.sliding->slid > 0);
  }
}

}  // namespace trismooth::touching_lines_test

// SPDX-License-Identifier: BSD-3-Clause
// Sliding as the library offers it, on meshes whose lines are known.

#include "trismooth/smoothing/sliding.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/distorted_meshes.h"
#include "support/scratch_folder.h"
#include "support/sliding_meshes.h"
#include "support/test_meshes.h"

namespace trismooth::sliding_test {

using namespace sliding_meshes;

constexpr std::int32_t side = 12;

Mesh square_with_uneven_sides(std::uint64_t seed) {
  return uneven_square(side, 0.4, seed);
}

std::string complaint(const Constraints& constraints) {
  const Mesh mesh = square_with_uneven_sides(1);
  return message_of<std::invalid_argument>([&] { smoothed(mesh, constraints); });
}

/// The largest of | |p| - radius | over points and middles of the edges of a circle of vertices.
double off_circle(const std::vector<Point>& circle, double radius) {
  double most = 0;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const Point a = circle[i];
    const Point b = circle[(i + 1) % circle.size()];
    for (const Point p : {a, Point{(a.x + b.x) / 2, (a.y + b.y) / 2}}) {
      most = std::max(most, std::abs(std::hypot(p.x, p.y) - radius));
    }
  }
  return most;
}

TEST_CASE("vertices of a square's sides slide, its corners stay, and the sides keep their coordinate to the bit") {
  for (const Method method : trismooth::values_of<Method>()) {
    const Mesh mesh = square_with_uneven_sides(2);
    Constraints constraints;
    constraints.slide.along = Slide::straight;
    const Smoothed found = smoothed(mesh, constraints, method);
    REQUIRE(found.result.sliding);
    CHECK(found.result.sliding->chains == 4);
    CHECK(found.result.sliding->vertices == 4 * (side - 2));
    CHECK(found.result.sliding->slid > side);
    CHECK(found.result.sliding->largest_deviation < 1e-15);
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      const Point before = mesh.points[v];
      for (const double wall : {0.0, 1.0}) {
        CHECK((before.x != wall || found.at(v).x == wall));
        CHECK((before.y != wall || found.at(v).y == wall));
      }
    }
    for (const std::int32_t corner : {0, side - 1, side * (side - 1), side * side - 1}) {
      CHECK(is_at(found, mesh, corner));
    }
  }
}

TEST_CASE("on a side at minus zero the coordinate keeps its sign") {
  Mesh mesh = square_with_uneven_sides(4);
  for (std::int32_t i = 0; i < side; ++i) {
    mesh.points[i].y = -0.0;
  }
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK_FALSE(is_at(found, mesh, side / 2));
  for (std::int32_t i = 0; i < side; ++i) {
    CHECK(same_bits(found.at(i).y, -0.0));
  }
}

TEST_CASE("triangles of corners that get worse than they were, but not than the worst was, hold nobody back") {
  // Without sliding the smallest shape is that of some triangle inside; those at corners are halves of squares.
  const Mesh mesh = distorted_meshes::displaced(30, 0.3, 7);
  const auto smallest_shape = [&](const std::vector<double>& xy) {
    double smallest = 1;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto at = [&xy](std::int32_t v) { return Point{xy[2 * v], xy[2 * v + 1]}; };
      const Point u{at(b).x - at(a).x, at(b).y - at(a).y};
      const Point v{at(c).x - at(a).x, at(c).y - at(a).y};
      const Point w{v.x - u.x, v.y - u.y};
      const double squares = u.x * u.x + u.y * u.y + v.x * v.x + v.y * v.y + w.x * w.x + w.y * w.y;
      smallest = std::min(smallest, 2 * std::numbers::sqrt3 * (u.x * v.y - u.y * v.x) / squares);
    }
    return smallest;
  };
  Constraints constraints;
  const Smoothed held = smoothed(mesh, constraints);
  constraints.slide.along = Slide::straight;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK(found.result.sliding->slid > 50);
  CHECK(found.result.reverted_vertices < 10);
  CHECK(smallest_shape(found.xy) > smallest_shape(held.xy));
}

TEST_CASE("where sliding would have nearly all of a regular grid go back, it comes out as without sliding") {
  const Mesh mesh = regular_grid(41, 3);
  Constraints constraints;
  const Smoothed held = smoothed(mesh, constraints);
  REQUIRE(held.result.moved_vertices > 100);
  constraints.slide.along = Slide::straight;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK(found.result.sliding->given_up);
  CHECK(found.result.sliding->vertices == 4 * 39);
  CHECK(found.result.sliding->slid == 0);
  CHECK(found.result.moved_vertices == held.result.moved_vertices);
  CHECK(found.result.sweeps == held.result.sweeps);
  for (std::size_t i = 0; i < found.xy.size(); ++i) {
    CHECK(same_bits(found.xy[i], held.xy[i]));
  }
}

TEST_CASE("without being asked to nothing slides") {
  const Mesh mesh = square_with_uneven_sides(3);
  const Smoothed found = smoothed(mesh, {});
  CHECK_FALSE(found.result.sliding);
  for (std::int32_t v = 0; v < side; ++v) {
    CHECK(is_at(found, mesh, v));
  }
}

TEST_CASE("vertices of circles slide all round, no further from them than they may") {
  constexpr std::int32_t around = 60;
  constexpr std::int32_t rings = 8;
  const Mesh mesh = uneven_annulus(around, rings, 4);
  Constraints constraints;
  constraints.slide.along = Slide::curves;
  for (const double deviation : {1e-3, 1e-2, 0.1}) {
    constraints.slide.deviation = deviation;
    const Smoothed found = smoothed(mesh, constraints);
    REQUIRE(found.result.sliding);
    CHECK(found.result.sliding->chains == 2);
    CHECK(found.result.sliding->vertices == 2 * around);
    CHECK(found.result.sliding->slid > around);
    CHECK(found.result.sliding->relative_deviation <= deviation);
    CHECK(found.result.sliding->relative_deviation > 0.1 * deviation);
    CHECK(found.result.sliding->largest_deviation <= deviation * 2 * std::numbers::pi / around * 1.7);
  }
  constraints.slide.along = Slide::straight;
  const Smoothed straight = smoothed(mesh, constraints);
  CHECK(straight.result.sliding->vertices == 0);
}

TEST_CASE("vertices slide to the same places on any number of threads") {
  const Mesh mesh = uneven_annulus(1200, 3, 6);
  Constraints constraints;
  constraints.slide.along = Slide::curves;
  constraints.slide.curve = SlideCurve::spline;
  for (const Method method : {Method::smart, Method::mean_ratio}) {
    std::vector<double> alone;
    for (const int threads : {1, 2, 5}) {
      trismooth::SmoothingOptions options;
      options.method = method;
      options.threads = threads;
      options.max_sweeps = 20;
      options.layers = trismooth::Layers::smooth;
      std::vector<double> xy = mesh.xy();
      const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints, options);
      CHECK(result.sliding->slid > 1200);
      if (threads == 1) {
        alone = xy;
      }
      for (std::size_t i = 0; i < xy.size(); ++i) {
        REQUIRE(same_bits(xy[i], alone[i]));
      }
    }
  }
}

TEST_CASE("on the spline through its vertices a circle stays a circle, where edges would cut it") {
  constexpr std::int32_t around = 200;
  constexpr std::int32_t rings = 12;
  const Mesh mesh = uneven_annulus(around, rings, 5);
  Constraints constraints;
  constraints.slide.along = Slide::curves;
  constraints.slide.deviation = 0.05;
  const auto outer = [&](SlideCurve curve) {
    constraints.slide.curve = curve;
    const Smoothed found = smoothed(mesh, constraints);
    CHECK(found.result.sliding->slid > around);
    CHECK(found.result.sliding->relative_deviation <= 0.05);
    std::vector<Point> circle;
    double off = 0;
    for (std::int32_t v = (rings - 1) * around; v < rings * around; ++v) {
      circle.push_back(found.at(v));
      off = std::max(off, std::abs(std::hypot(found.at(v).x, found.at(v).y) - 1));
    }
    return std::pair(off, off_circle(circle, 1));
  };
  const auto [vertices_on_spline, edges_on_spline] = outer(SlideCurve::spline);
  const auto [vertices_on_edges, edges_on_edges] = outer(SlideCurve::polyline);
  CHECK(vertices_on_spline < 2e-6);  // a cubic of steps of 2 pi / 200
  CHECK(vertices_on_edges > 1e-4);
  CHECK(edges_on_spline < edges_on_edges);
}

TEST_CASE("tags end lines, contradicting tags hold, and lines inside a region are slid on") {
  test_meshes::Random random(8);
  const Mesh mesh = distorted_meshes::grid(side, [&random](Point p) {
    const double off = 0.3 / (side - 1) * random.between(-1, 1);
    return Point{p.x > 0 && p.x < 1 ? p.x + off : p.x, p.y};
  });
  // The bottom in two parts, and row 5 inside as a line.
  std::vector<std::int32_t> lines;
  std::vector<std::int32_t> tags;
  for (std::int32_t i = 0; i + 1 < side; ++i) {
    lines.insert(lines.end(), {i, i + 1});
    tags.push_back(i < 4 ? 7 : 8);
    lines.insert(lines.end(), {5 * side + i, 5 * side + i + 1});
    tags.push_back(9);
  }
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  constraints.slide.lines = lines;
  constraints.slide.line_tags = tags;
  const Smoothed found = smoothed(mesh, constraints);
  CHECK(is_at(found, mesh, 4));
  // Four sides, of which one is in two parts, and two of which the line inside divides; and that.
  CHECK(found.result.sliding->chains == 8);
  CHECK(found.result.sliding->slid > side);
  for (std::int32_t i = 0; i < side; ++i) {
    CHECK(found.at(5 * side + i).y == mesh.points[5 * side + i].y);
  }
  lines.insert(lines.end(), {8, 9});  // once more, with another tag
  tags.push_back(1);
  constraints.slide.lines = lines;
  constraints.slide.line_tags = tags;
  const Smoothed contradicting = smoothed(mesh, constraints);
  CHECK(is_at(contradicting, mesh, 8));
  CHECK(is_at(contradicting, mesh, 9));
  constraints.slide.along = Slide::off;
  const Smoothed held = smoothed(mesh, constraints);
  CHECK_FALSE(held.result.sliding);
  CHECK(is_at(held, mesh, 5 * side + 5));
}

TEST_CASE("of few digits, vertices of a line stay apart") {
  // x has steps of 1/8 there. Neighbours on the lower side are 1 to 3 of them apart, and triangles lean over, so that
  // vertices are drawn towards each other.
  constexpr float far = 1 << 20;
  constexpr float step = 0.125F;
  constexpr std::int32_t columns = 20;
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  std::int64_t slid = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test_meshes::Random random(seed);
    Mesh mesh = distorted_meshes::grid(columns, [](Point p) { return p; });
    float x = far;
    for (std::int32_t i = 0; i < columns; ++i) {
      for (std::int32_t j = 0; j < columns; ++j) {
        const bool is_inner = i > 0 && i + 1 < columns && j > 0 && j + 1 < columns;
        mesh.points[j * columns + i] = {x + (is_inner ? step * static_cast<float>(random.below(5) - 2) : 0),
                                        step * static_cast<float>(2 * j)};
      }
      x += step * static_cast<float>(1 + random.below(3));
    }
    std::vector<float> xy;
    for (const Point p : mesh.points) {
      xy.insert(xy.end(), {static_cast<float>(p.x), static_cast<float>(p.y)});
    }
    trismooth::SmoothingOptions options;
    options.method = seed % 2 == 0 ? Method::mean_ratio : Method::weighted;
    options.guard = false;
    const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints, options);
    slid += result.sliding->slid;
    for (std::int32_t i = 0; i + 1 < columns; ++i) {
      CHECK(xy[2 * i] < xy[2 * (i + 1)]);
    }
  }
  CHECK(slid > 100);
}

TEST_CASE("a line of one edge has nothing that slides, and one of two edges a vertex") {
  const Mesh one{{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}};
  Constraints constraints;
  constraints.slide.along = Slide::curves;
  constraints.slide.corner_angle = 10;
  CHECK(smoothed(one, constraints).result.sliding->vertices == 0);
  const Mesh two{{{0, 0}, {0.2, 0}, {1, 0}, {0.5, 1}}, {{0, 1, 3}, {1, 2, 3}}};
  const Smoothed found = smoothed(two, constraints);
  CHECK(found.result.sliding->vertices == 1);
  CHECK(std::abs(found.at(1).x - 0.5) < 0.01);
  CHECK(found.at(1).y == 0);
}

TEST_CASE("numbers of sliding that are none are refused by name") {
  Constraints constraints;
  constraints.slide.along = Slide::straight;
  constraints.slide.corner_angle = -1;
  CHECK(complaint(constraints) == "the corner angle of sliding is to be from 0 to 180 degrees");
  constraints.slide.corner_angle = 30;
  constraints.slide.deviation = std::nan("");
  CHECK(complaint(constraints) == "the deviation of sliding is to be from 0 to 1 edge lengths");
  constraints.slide.deviation = 0;
  const std::vector<std::int32_t> odd{0, 1, 2};
  constraints.slide.lines = odd;
  CHECK(complaint(constraints) == "Sliding::lines has 3 entries, expected two vertices for each");
  const std::vector<std::int32_t> beyond{0, side * side};
  constraints.slide.lines = {};
  constraints.slide.links = beyond;
  CHECK(complaint(constraints) == "Sliding::links: vertex 144 is not one of the 144 vertices");
  const std::vector<std::int32_t> edge{0, 1};
  constraints.slide.links = {};
  constraints.slide.lines = edge;
  constraints.slide.line_tags = odd;
  CHECK(complaint(constraints) == "Sliding::line_tags has 3 entries, expected 1 or none");
}

}  // namespace trismooth::sliding_test

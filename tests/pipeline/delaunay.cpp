// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "catch.h"

namespace trismooth::delaunay_test {

__extension__ using Int128 = __int128;
using Points = std::vector<GridPoint>;
using Triangle = std::array<std::int32_t, 3>;

constexpr std::int32_t largest = (1 << 30) - 1;

std::int64_t area_of(GridPoint a, GridPoint b, GridPoint c) {
  return (std::int64_t{b[0]} - a[0]) * (std::int64_t{c[1]} - a[1]) -
         (std::int64_t{b[1]} - a[1]) * (std::int64_t{c[0]} - a[0]);
}

/// > 0 where d is inside the circle of the counter-clockwise a, b, c: the 4 x 4 determinant of rows
/// (x, y, x^2 + y^2, 1), expanded by rows from absolute coordinates. Below 6 * 2^121 in magnitude.
Int128 circle_determinant(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto row = [](GridPoint p) {
    return std::array<Int128, 3>{p[0], p[1], Int128{p[0]} * p[0] + Int128{p[1]} * p[1]};
  };
  const auto minor = [](const auto& u, const auto& v, const auto& w) {
    return u[2] * (v[0] * w[1] - v[1] * w[0]) - v[2] * (u[0] * w[1] - u[1] * w[0]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
  };
  const auto p = row(a);
  const auto q = row(b);
  const auto r = row(c);
  const auto s = row(d);
  return minor(p, q, r) - minor(p, q, s) + minor(p, r, s) - minor(q, r, s);
}

/// The hull's outline, counter-clockwise, with every point that lies on it (A. M. Andrew's monotone chain).
std::vector<GridPoint> hull_outline(Points points) {
  std::sort(points.begin(), points.end());
  std::vector<GridPoint> outline;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = outline.size();
    for (const GridPoint point : points) {
      while (outline.size() >= begin + 2 && area_of(outline.end()[-2], outline.back(), point) < 0) {
        outline.pop_back();
      }
      outline.push_back(point);
    }
    outline.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return outline;
}

/// Checks everything that makes `triangles` a triangulation of all points: orientation, hull, area, Euler's formula,
/// and edges that fit together.
void check_triangulation(const Points& points, const std::vector<Triangle>& triangles) {
  std::int64_t area = 0;
  std::vector<char> used(points.size(), 0);
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const Triangle& triangle : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      REQUIRE(triangle[corner] >= 0);
      REQUIRE(triangle[corner] < static_cast<std::int32_t>(points.size()));
      used[triangle[corner]] = 1;
      REQUIRE(edges.insert({triangle[corner], triangle[(corner + 1) % 3]}).second);
    }
    const std::int64_t triangle_area = area_of(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
    REQUIRE(triangle_area > 0);
    area += triangle_area;
  }
  CHECK(std::all_of(used.begin(), used.end(), [](char is_used) { return is_used != 0; }));

  const std::vector<GridPoint> outline = hull_outline(points);
  std::int64_t hull_area = 0;
  for (std::size_t i = 2; i < outline.size(); ++i) {
    hull_area += area_of(outline[0], outline[i - 1], outline[i]);
  }
  CHECK(area == hull_area);
  CHECK(triangles.size() == 2 * points.size() - 2 - outline.size());

  std::set<std::pair<GridPoint, GridPoint>> boundary;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) == 0) {
      boundary.insert({points[from], points[to]});
    }
  }
  std::set<std::pair<GridPoint, GridPoint>> outline_edges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    outline_edges.insert({outline[i], outline[(i + 1) % outline.size()]});
  }
  CHECK(boundary == outline_edges);
}

/// No point strictly inside any triangle's circle, each point tried with each triangle.
void check_empty_circles(const Points& points, const std::vector<Triangle>& triangles) {
  std::size_t offences = 0;
  for (const Triangle& triangle : triangles) {
    for (const GridPoint point : points) {
      if (circle_determinant(points[triangle[0]], points[triangle[1]], points[triangle[2]], point) > 0) {
        ++offences;
      }
    }
  }
  CHECK(offences == 0);
}

void check_delaunay(const Points& points) {
  const std::vector<Triangle> triangles = delaunay(points);
  check_triangulation(points, triangles);
  check_empty_circles(points, triangles);
}

void shuffle(Points& points, std::uint64_t seed) {
  std::shuffle(points.begin(), points.end(), std::mt19937_64(seed));
}

Points distinct_random_points(std::size_t count, std::int32_t bound, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  std::set<GridPoint> points;
  while (points.size() < count) {
    points.insert({static_cast<std::int32_t>(bits() % bound), static_cast<std::int32_t>(bits() % bound)});
  }
  Points result(points.begin(), points.end());
  shuffle(result, seed);
  return result;
}

Points grid(std::int32_t columns, std::int32_t rows, std::int32_t spacing) {
  Points points;
  for (std::int32_t x = 0; x < columns; ++x) {
    for (std::int32_t y = 0; y < rows; ++y) {
      points.push_back({x * spacing, y * spacing});
    }
  }
  return points;
}

/// All points of the grid on the circle of radius 5 * 13 * 17 * 29 about the centre: 324 of them, exactly cocircular.
Points points_on_circle(GridPoint centre) {
  constexpr auto radius = std::int64_t{5} * 13 * 17 * 29;
  Points points;
  for (std::int64_t x = -radius; x <= radius; ++x) {
    const std::int64_t rest = radius * radius - x * x;
    const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(rest))));
    if (y * y == rest) {
      points.push_back({static_cast<std::int32_t>(centre[0] + x), static_cast<std::int32_t>(centre[1] + y)});
      if (y != 0) {
        points.push_back({static_cast<std::int32_t>(centre[0] + x), static_cast<std::int32_t>(centre[1] - y)});
      }
    }
  }
  return points;
}

TEST_CASE("the in-circle test is exact to the last unit at the ends of the grid") {
  const GridPoint a{0, 0};
  const GridPoint b{largest, 0};
  const GridPoint c{largest, largest};
  CHECK_FALSE(trismooth::in_circle(a, b, c, {0, largest}));
  CHECK(trismooth::in_circle(a, b, c, {1, largest}));
  CHECK(trismooth::in_circle(a, b, c, {0, largest - 1}));
  CHECK_FALSE(trismooth::in_circle(a, b, {largest - 1, largest}, {0, largest}));
  CHECK(trismooth::doubled_area(a, b, c) == std::int64_t{largest} * largest);
  CHECK(trismooth::doubled_area(a, c, {largest, largest - 1}) == -std::int64_t{largest});
}

TEST_CASE("the in-circle test agrees with the expanded determinant") {
  std::mt19937_64 bits(3);
  const std::int32_t bound = GENERATE(8, 1000, 1 << 30);
  for (int i = 0; i < 20000; ++i) {
    std::array<GridPoint, 4> p{};
    for (GridPoint& point : p) {
      point = {static_cast<std::int32_t>(bits() % bound), static_cast<std::int32_t>(bits() % bound)};
    }
    if (area_of(p[0], p[1], p[2]) > 0) {
      REQUIRE(trismooth::in_circle(p[0], p[1], p[2], p[3]) == (circle_determinant(p[0], p[1], p[2], p[3]) > 0));
    }
  }
}

TEST_CASE("random points get their Delaunay triangulation") {
  const std::size_t count = GENERATE(3, 4, 5, 6, 7, 8, 10, 20, 50, 400);
  const std::int32_t bound = GENERATE(64, 1000, 1 << 30);
  for (std::uint64_t seed = 0; seed < (count < 50 ? 40U : 2U); ++seed) {
    CAPTURE(count, bound, seed);
    check_delaunay(distinct_random_points(count, bound, seed));
  }
}

TEST_CASE("crowded cells, where most points are collinear or cocircular with others, get their triangulation") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    check_delaunay(distinct_random_points(12, 4, seed));
  }
}

TEST_CASE("grids get a Delaunay triangulation in any order of their points") {
  for (Points points :
       {grid(2, 2, largest), grid(20, 20, 1), grid(3, 150, 7), grid(150, 2, 1000), grid(24, 24, 1 << 25)}) {
    check_delaunay(points);
    shuffle(points, 5);
    check_delaunay(points);
  }
}

TEST_CASE("points on a circle, with and without its centre, get a Delaunay triangulation") {
  const GridPoint centre{1 << 29, 1 << 29};
  Points points = points_on_circle(centre);
  REQUIRE(points.size() == 324);
  shuffle(points, 7);
  check_delaunay(points);
  points.push_back(centre);
  check_delaunay(points);
}

TEST_CASE("concentric circles of cocircular points get a Delaunay triangulation") {
  Points points;
  for (const std::int32_t factor : {1, 2, 3, 1000}) {
    for (const GridPoint p : {GridPoint{3, 4}, GridPoint{4, 3}, GridPoint{5, 0}, GridPoint{0, 5}}) {
      for (const std::int32_t sign_x : {-1, 1}) {
        for (const std::int32_t sign_y : {-1, 1}) {
          points.push_back({(1 << 29) + sign_x * factor * p[0], (1 << 29) + sign_y * factor * p[1]});
        }
      }
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  check_delaunay(points);
}

TEST_CASE("collinear points and one apart make a fan") {
  const auto direction = GENERATE(GridPoint{1, 0}, GridPoint{0, 1}, GridPoint{1, 1}, GridPoint{3, 7});
  const auto apart = GENERATE(GridPoint{1 << 20, 0}, GridPoint{0, 1 << 20}, GridPoint{123456, 1234567});
  Points points;
  for (std::int32_t i = 1; i <= 200; ++i) {
    points.push_back({direction[0] * i * 100, direction[1] * i * 100});
  }
  if (area_of(points[0], points[1], apart) != 0) {
    points.push_back(apart);
    shuffle(points, 11);
    check_delaunay(points);
    CHECK(delaunay(points).size() == 199);
  }
}

TEST_CASE("two parallel lines, one unit apart and as long as the grid, get their triangulation") {
  Points points;
  for (std::int32_t i = 0; i < 60; ++i) {
    points.push_back({i * (largest / 59), largest / 2});
    points.push_back({i * (largest / 59) + (i < 59 ? 1 : 0), largest / 2 + 1});
  }
  shuffle(points, 13);
  check_delaunay(points);
}

TEST_CASE("near-duplicates get their triangulation") {
  Points points;
  for (const GridPoint centre : distinct_random_points(20, largest - 2, 17)) {
    for (const GridPoint offset : {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{0, 1}, GridPoint{2, 1}}) {
      points.push_back({centre[0] + offset[0], centre[1] + offset[1]});
    }
  }
  check_delaunay(points);
}

TEST_CASE("the far corners of the grid and points beside them get their triangulation") {
  Points points{{0, 0}, {largest, 0}, {0, largest}, {largest, largest}, {largest / 2, largest / 2}};
  for (const GridPoint corner : Points(points.begin(), points.begin() + 4)) {
    const std::int32_t dx = corner[0] == 0 ? 1 : -1;
    const std::int32_t dy = corner[1] == 0 ? 1 : -1;
    points.push_back({corner[0] + dx, corner[1]});
    points.push_back({corner[0] + dx, corner[1] + dy});
    points.push_back({corner[0], corner[1] + 2 * dy});
  }
  check_delaunay(points);
}

TEST_CASE("points on a parabola get their triangulation") {
  Points points;
  for (std::int32_t x = -150; x <= 150; ++x) {
    points.push_back({(1 << 29) + x, x * x});
  }
  check_delaunay(points);
}

TEST_CASE("a hundred thousand points get a triangulation that fits together") {
  const Points points = distinct_random_points(100000, 1 << 30, 19);
  check_triangulation(points, delaunay(points));
}

TEST_CASE("a dense grid of ninety thousand points gets a triangulation that fits together") {
  const Points points = grid(300, 300, 1);
  const std::vector<Triangle> triangles = delaunay(points);
  check_triangulation(points, triangles);
  // The only empty circles that no point of such a grid enters are those of half a cell.
  CHECK(std::all_of(triangles.begin(), triangles.end(),
                    [&](const Triangle& t) { return area_of(points[t[0]], points[t[1]], points[t[2]]) == 1; }));
}

TEST_CASE("the same points give the same triangles in the same order") {
  const Points points = distinct_random_points(2000, 1 << 30, 23);
  CHECK(delaunay(points) == delaunay(points));
}

TEST_CASE("the order of the points does not matter to the triangles where no four are cocircular") {
  const auto geometry = [](const Points& points) {
    std::set<std::array<GridPoint, 3>> triangles;
    for (const Triangle& t : delaunay(points)) {
      std::array<GridPoint, 3> corners{points[t[0]], points[t[1]], points[t[2]]};
      std::sort(corners.begin(), corners.end());
      triangles.insert(corners);
    }
    return triangles;
  };
  Points points = distinct_random_points(2000, 1 << 30, 29);
  const auto triangles = geometry(points);
  shuffle(points, 31);
  CHECK(geometry(points) == triangles);
}

TEST_CASE("points that span no area have no triangle") {
  CHECK(delaunay({}).empty());
  CHECK(delaunay(Points{{5, 5}}).empty());
  CHECK(delaunay(Points{{5, 5}, {1, 2}}).empty());
  CHECK(delaunay(Points{{0, 0}, {1, 1}, {largest, largest}, {17, 17}}).empty());
}

TEST_CASE("a point that occurs twice is refused") {
  CHECK_THROWS_AS(delaunay(Points{{1, 1}, {1, 1}}), std::invalid_argument);
  Points points = distinct_random_points(500, 1 << 30, 37);
  points.push_back(points[123]);
  CHECK_THROWS_AS(delaunay(points), std::invalid_argument);
}

TEST_CASE("a point outside the grid is refused") {
  CHECK_THROWS_AS(delaunay(Points{{0, 0}, {1, 0}, {0, -1}}), std::invalid_argument);
  CHECK_THROWS_AS(delaunay(Points{{0, 0}, {largest + 1, 0}, {0, 1}}), std::invalid_argument);
}

}  // namespace trismooth::delaunay_test

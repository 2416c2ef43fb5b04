// SPDX-License-Identifier: BSD-3-Clause
// What is said of boundaries that leave the mesh no room: that cross or touch themselves, fold, or turn inside out.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <set>
#include <vector>

#include "trismooth/smoothing/moving/crossings.h"
#include "trismooth/smoothing/moving_mesh.h"

#include "catch.h"
#include "support/rotor.h"
#include "support/test_meshes.h"

namespace trismooth::moving_crossings_test {

using test_meshes::Mesh;
using test_meshes::Rotor;
using test_meshes::turned;
using Points = std::vector<Point2<double>>;

/// Where on `one` the line of `other` crosses it, and the other way round, as parts of them, solved for as a system.
std::array<double, 2> parts_at_crossing(const Points& points, std::array<std::int32_t, 2> one,
                                        std::array<std::int32_t, 2> other) {
  const Point2<double> a = points[one[1]] - points[one[0]];
  const Point2<double> b = points[other[1]] - points[other[0]];
  const Point2<double> between = points[other[0]] - points[one[0]];
  const double determinant = b.x * a.y - a.x * b.y;
  return {(b.x * between.y - between.x * b.y) / determinant, (a.x * between.y - a.y * between.x) / determinant};
}

/// Whether edges that are not nearly parallel cross each other.
bool do_cross(const Points& points, std::array<std::int32_t, 2> one, std::array<std::int32_t, 2> other) {
  const Point2<double> a = points[one[1]] - points[one[0]];
  const Point2<double> b = points[other[1]] - points[other[0]];
  const auto [here, there] = parts_at_crossing(points, one, other);
  return std::abs(a.x * b.y - a.y * b.x) > 1e-9 * std::hypot(a.x, a.y) * std::hypot(b.x, b.y) && here > 1e-9 &&
         here < 1 - 1e-9 && there > 1e-9 && there < 1 - 1e-9;
}

/// Two edges, whichever way they are listed.
std::array<std::int32_t, 4> in_order(std::array<std::int32_t, 2> one, std::array<std::int32_t, 2> other) {
  std::ranges::sort(one);
  std::ranges::sort(other);
  const auto& [first, second] = std::minmax(one, other);
  return {first[0], first[1], second[0], second[1]};
}

TEST_CASE("a boundary that crosses itself is named, edge by edge") {
  const Rotor rotor;
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices());
  std::vector<std::array<std::int32_t, 2>> edges;
  for (std::int32_t i = 0; i < rotor.sectors; ++i) {
    const std::int32_t next = (i + 1) % rotor.sectors;
    edges.push_back({i, next});
    edges.push_back({rotor.sectors * rotor.rings + i, rotor.sectors * rotor.rings + next});
  }
  std::size_t most = 0;
  for (const double shift : {0.0, 2.9, 3.4, 4.1, 9.0}) {
    Points points = rotor.at(20 * std::numbers::pi / 180);
    for (std::size_t v = 0; v < points.size(); ++v) {
      points[v].x += rotor.is_on_rotor(v) ? shift : 0;
    }
    std::set<std::array<std::int32_t, 4>> expected;
    for (const auto& one : edges) {
      for (const auto& other : edges) {
        if (one < other && do_cross(points, one, other)) {
          expected.insert(in_order(one, other));
        }
      }
    }
    std::set<std::array<std::int32_t, 4>> found;
    for (const auto& [a, b, c, d] : moving.follow(points).crossings) {
      found.insert(in_order({a, b}, {c, d}));
    }
    CAPTURE(shift);
    CHECK(found == expected);
    most = std::max(most, found.size());
  }
  CHECK(most >= 2);
}

/// How far a point is from an edge.
long double distance_to(const Points& points, std::int32_t v, std::array<std::int32_t, 2> edge) {
  using Real = long double;
  const auto [a, b] = edge;
  const Real x = Real(points[b].x) - points[a].x;
  const Real y = Real(points[b].y) - points[a].y;
  const Real to_x = Real(points[v].x) - points[a].x;
  const Real to_y = Real(points[v].y) - points[a].y;
  const Real part = std::clamp((to_x * x + to_y * y) / (x * x + y * y), Real(0), Real(1));
  return std::hypot(to_x - part * x, to_y - part * y);
}

/// Whether an end of one edge lies on the other one; of edges that share an end the other ends count.
bool do_touch(const Points& points, std::array<std::int32_t, 2> one, std::array<std::int32_t, 2> other) {
  const auto lies_on = [&](std::int32_t v, std::array<std::int32_t, 2> edge) {
    return v != edge[0] && v != edge[1] && distance_to(points, v, edge) < 1e-15L;
  };
  return lies_on(one[0], other) || lies_on(one[1], other) || lies_on(other[0], one) || lies_on(other[1], one);
}

TEST_CASE("of edges anywhere those that cross or touch are found, whichever they are") {
  test_meshes::Random dice(11);
  Points points;
  for (int i = 0; i < 240; ++i) {
    // Some lie on a line that is slanted, some in a row, and lengths are of all kinds.
    const double along = dice.between(0, 1);
    const double away = i % 3 == 0 ? 0 : dice.between(-0.05, 0.05);
    points.push_back({0.6 * along - 0.8 * away, i % 5 == 0 ? 0.25 : 0.8 * along + 0.6 * away});
    if (i % 7 == 6) {
      points.back() = points[static_cast<std::size_t>(dice.below(i))];  // in the place of another one
    }
  }
  std::vector<std::array<std::int32_t, 2>> edges;
  for (int i = 0; i < 300; ++i) {
    const std::int32_t a = dice.below(240);
    const std::int32_t b = i % 4 == 0 ? dice.below(240) : (a + 1) % 240;
    if (!(points[a] == points[b])) {
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<std::array<std::int32_t, 2>> expected;
  std::size_t touching = 0;
  for (std::int32_t one = 0; one < std::ssize(edges); ++one) {
    for (std::int32_t other = one + 1; other < std::ssize(edges); ++other) {
      const bool is_crossing = do_cross(points, edges[one], edges[other]);
      if (is_crossing || do_touch(points, edges[one], edges[other])) {
        expected.push_back({one, other});
        touching += is_crossing ? 0 : 1;
      }
    }
  }
  CHECK(touching > 300);
  CHECK(expected.size() > 500);
  std::vector<std::array<std::int32_t, 2>> found;
  for (const MeetingEdges& meeting : meeting_edges(edges, points, 1000000)) {
    found.push_back({meeting.one, meeting.other});
    CHECK(meeting.cross == do_cross(points, edges[meeting.one], edges[meeting.other]));
  }
  std::vector<std::array<std::int32_t, 2>> different;
  std::ranges::set_symmetric_difference(found, expected, std::back_inserter(different));
  CHECK(different.empty());
  CHECK(meeting_edges(edges, points, 7).size() == 7);
}

TEST_CASE("a triangle whose corners come to lie in one place has no shape, as seen from the reference") {
  const Points reference{{0, 0}, {1, 0}, {0, 1}};
  const std::vector<std::int32_t> triangles{0, 1, 2};
  MovingMesh moving(reference, triangles);
  Points points{{3, 4}, {3, 4}, {3, 4}};
  const FollowResult result = moving.follow(points);
  CHECK(result.min_relative_shape == 0);
  CHECK(result.mean_relative_shape == 0);
  CHECK(result.smoothing.degenerate == 1);
  CHECK(result.invalid_held == 1);
}

/// Two triangles on either side of a slit whose faces are in the same place, and one that lies across others.
struct Slit {
  Points at_rest{{0, 0}, {1, 0}, {0.5, 1}, {0, 0}, {1, 0}, {0.5, -1}, {0.2, 0.5}, {0.8, 0.5}, {0.5, -0.5}};
  std::vector<std::int32_t> triangles{0, 1, 2, 4, 3, 5, 7, 6, 8};
  MovingMesh moving{at_rest, triangles};

  FollowResult follow(Points points) { return moving.follow(points); }
};

TEST_CASE("a boundary that touches or crosses itself as it did in the reference is not said to") {
  Slit slit;
  CHECK(slit.follow(slit.at_rest).crossings.empty());
  Points apart = slit.at_rest;
  for (const std::size_t v : {6, 7, 8}) {
    apart[v].x += 5;
  }
  CHECK(slit.follow(apart).crossings.empty());
  Points turned_as_one = slit.at_rest;
  for (Point2<double>& p : turned_as_one) {
    p = turned(p, 1.1);
  }
  CHECK(slit.follow(turned_as_one).crossings.empty());
  Points through = apart;
  for (const std::size_t v : {3, 4, 5}) {
    through[v].y += 0.25;
  }
  CHECK_FALSE(slit.follow(through).crossings.empty());
}

/// A ring of triangles around a square hole.
struct Ring {
  static constexpr int around = 16;

  Ring() {
    for (int j = 0; j <= 2; ++j) {
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        points.push_back({(1 + j) * std::cos(angle), (1 + j) * std::sin(angle)});
        if (j < 2) {
          const int next = (i + 1) % around;
          triangles.insert(triangles.end(), {j * around + i, (j + 1) * around + i, (j + 1) * around + next});
          triangles.insert(triangles.end(), {j * around + i, (j + 1) * around + next, j * around + next});
        }
      }
    }
  }

  Points points;
  std::vector<std::int32_t> triangles;
};

TEST_CASE("a mesh that lies over itself says so, though nothing is inverted and no edges cross") {
  SECTION("where a hole has been turned inside out") {
    const Ring ring;
    MovingMesh moving(ring.points, ring.triangles);
    Points points = ring.points;
    for (int i = 0; i < Ring::around; ++i) {
      points[i].x = -points[i].x;
    }
    const FollowResult result = moving.follow(points);
    CHECK(result.crossings.empty());
    CHECK((result.smoothing.inverted > 0 || !result.overlaps.empty()));
    CHECK(moving.follow(points = ring.points).overlaps.empty());
  }
  SECTION("where a slit is pushed through itself between its tips") {
    // A strip of squares above a line and one below it; from 1 to 3 they have vertices of their own on it.
    Points points;
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 5; ++i) {
        points.push_back({double(i), double(row - 1)});
      }
    }
    points.push_back({2, 0});  // the upper face
    std::vector<std::int32_t> triangles;
    for (int row = 0; row < 2; ++row) {
      for (int i = 0; i < 4; ++i) {
        const auto at = [&](int column, int line) {
          return line == 1 && column == 2 && row == 1 ? 15 : 5 * line + column;
        };
        triangles.insert(triangles.end(), {at(i, row), at(i + 1, row), at(i + 1, row + 1)});
        triangles.insert(triangles.end(), {at(i, row), at(i + 1, row + 1), at(i, row + 1)});
      }
    }
    MovingMesh moving(points, triangles);
    Points through = points;
    through[15].y = -0.2;
    const FollowResult result = moving.follow(through);
    CHECK(result.smoothing.inverted == 0);
    CHECK(result.overlaps == std::vector<std::int32_t>{6, 8});
    CHECK(moving.follow(points).overlaps.empty());
    Points to_rounding = points;
    to_rounding[15].y = -1e-15;
    CHECK(moving.follow(to_rounding).is_valid());
  }
}

TEST_CASE("a cavity whose faces go through each other says so, however little they do so beside its tips") {
  // Squares around a lens from (3, 6) to (9, 6), which is open.
  constexpr int side = 13;
  constexpr int middle = 6;
  Points open;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const bool is_of_lens = row == middle && column > 3 && column < 9;
      open.push_back({double(column), is_of_lens ? row - 0.3 : row});
    }
  }
  for (int column = 4; column < 9; ++column) {
    open.push_back({double(column), middle + 0.3});
  }
  std::vector<std::int32_t> triangles;
  for (int row = 0; row + 1 < side; ++row) {
    for (int column = 0; column + 1 < side; ++column) {
      const auto at = [row](int x, int y) {
        return y == middle && row >= middle && x > 3 && x < 9 ? side * side + x - 4 : y * side + x;
      };
      triangles.insert(triangles.end(), {at(column, row), at(column + 1, row), at(column + 1, row + 1)});
      triangles.insert(triangles.end(), {at(column, row), at(column + 1, row + 1), at(column, row + 1)});
    }
  }
  MovingMesh moving(open, triangles);
  for (const double beside_tips : {0.1, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14}) {
    CAPTURE(beside_tips);
    Points through = open;
    for (int column = 4; column < 9; ++column) {
      const double by = column == 4 || column == 8 ? beside_tips : 0.3;
      through[side * side + column - 4].y = middle - by;
      through[middle * side + column].y = middle + by;
    }
    const FollowResult result = moving.follow(through);
    CHECK((!result.overlaps.empty() || !result.crossings.empty()));
    CHECK_FALSE(result.is_valid());
    Points still_open = open;
    for (const int column : {4, 8}) {
      still_open[side * side + column - 4].y = middle + beside_tips;
    }
    CHECK(moving.follow(still_open).is_valid());
  }
}

TEST_CASE("edges far from one that has become a point are not named") {
  // A square hole in a triangle, and a corner of it that goes onto the next one.
  const Points points{{0, 0}, {10, 0}, {0, 10}, {2, 2}, {3, 2}, {3, 3}, {2, 3}};
  const std::vector<std::int32_t> triangles{0, 1, 3, 1, 4, 3, 1, 5, 4, 1, 2, 5, 2, 6, 5, 2, 0, 6, 0, 3, 6};
  MovingMesh moving(points, triangles);
  Points now = points;
  now[4] = now[3];
  const FollowResult result = moving.follow(now);
  CHECK(result.smoothing.degenerate > 0);
  CHECK_FALSE(result.crossings.empty());
  for (const auto& [a, b, c, d] : result.crossings) {
    CAPTURE(a, b, c, d);
    const long double apart = std::min({distance_to(now, a, {c, d}), distance_to(now, b, {c, d}),
                                        distance_to(now, c, {a, b}), distance_to(now, d, {a, b})});
    CHECK((apart < 1e-9L || do_cross(now, {a, b}, {c, d})));
  }
}

TEST_CASE("edges that come to lie on each other are named") {
  SECTION("where a vertex of a side goes past the next one") {
    const Mesh mesh = test_meshes::jittered_grid(7, 7, 0, 1);
    MovingMesh moving(mesh.points, mesh.indices());
    Points points = mesh.points;
    points[3].x = points[4].x + 0.4 * (points[4].x - points[3].x);
    const FollowResult result = moving.follow(points);
    CHECK_FALSE(result.crossings.empty());
  }
  SECTION("where a vertex comes to lie on another edge") {
    const Ring ring;
    MovingMesh moving(ring.points, ring.triangles);
    Points points = ring.points;
    points[0] = {3, 0};  // that of the outer circle
    CHECK_FALSE(moving.follow(points).crossings.empty());
  }
}

TEST_CASE("the triangles that are inverted or degenerate are listed") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.2, 5);
  MovingMesh moving(mesh.points, mesh.indices());
  Points points = mesh.points;
  for (int i = 0; i < 9; ++i) {
    points[i].y = 1.5;
  }
  const FollowResult result = moving.follow(points);
  std::vector<std::int32_t> expected;
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Point2<double> ab = points[b] - points[a];
    const Point2<double> ac = points[c] - points[a];
    if (!(ab.x * ac.y - ab.y * ac.x > 0)) {
      expected.push_back(t);
    }
  }
  CHECK_FALSE(expected.empty());
  CHECK(result.invalid == expected);
}

}  // namespace trismooth::moving_crossings_test

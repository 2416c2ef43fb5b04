// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/random_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/pipeline/generate/grid_predicates.h"
#include "trismooth/quality/coarse_boundary.h"

#include "catch.h"

namespace trismooth::random_mesh_test {

double doubled_area(const RandomMesh& mesh, const std::array<std::int32_t, 3>& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

bool same(const RandomMesh& a, const RandomMesh& b) {
  return a.points == b.points && a.triangles == b.triangles;
}

/// Every vertex used, no two equal, all triangles counter-clockwise, every directed edge once.
void check_conforming(const RandomMesh& mesh) {
  std::vector<std::pair<double, double>> places;
  for (const Point2<double> point : mesh.points) {
    places.emplace_back(point.x, point.y);
  }
  std::sort(places.begin(), places.end());
  CHECK(std::adjacent_find(places.begin(), places.end()) == places.end());

  std::vector<char> used(mesh.points.size(), 0);
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : mesh.triangles) {
    REQUIRE(doubled_area(mesh, t) > 0);
    for (std::size_t i = 0; i < 3; ++i) {
      used[t[i]] = 1;
      edges.emplace_back(t[i], t[(i + 1) % 3]);
    }
  }
  CHECK(std::count(used.begin(), used.end(), 0) == 0);
  std::sort(edges.begin(), edges.end());
  CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
}

/// The ends of edges that have a triangle on one side only.
std::vector<std::pair<std::int32_t, std::int32_t>> boundary_edges(const RandomMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++sides[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> boundary;
  for (const auto& [edge, count] : sides) {
    if (count == 1) {
      boundary.push_back(edge);
    }
  }
  return boundary;
}

TEST_CASE("a random mesh has the vertices that were asked for, inside the unit square, and conforms") {
  const std::int64_t vertices = GENERATE(4, 5, 10, 1000, 20000);
  CAPTURE(vertices);
  const RandomMesh mesh = random_delaunay_mesh(vertices, 42);
  REQUIRE(static_cast<std::int64_t>(mesh.points.size()) == vertices);
  for (const Point2<double> point : mesh.points) {
    REQUIRE((point.x >= 0 && point.x < 1 && point.y >= 0 && point.y < 1));
    REQUIRE(std::ldexp(point.x, 30) == std::floor(std::ldexp(point.x, 30)));
    REQUIRE(std::ldexp(point.y, 30) == std::floor(std::ldexp(point.y, 30)));
  }
  check_conforming(mesh);
  CHECK(mesh.triangles.size() == 2 * mesh.points.size() - 2 - boundary_edges(mesh).size());
}

TEST_CASE("a random mesh depends on its seed and on nothing else") {
  const RandomMeshOptions options{GENERATE(GeneratedBoundary::random, GeneratedBoundary::resolved),
                                  GENERATE(300, 1 << 22)};
  const RandomMesh mesh = random_delaunay_mesh(1000, 7, options);
  CHECK(same(mesh, random_delaunay_mesh(1000, 7, options)));
  CHECK_FALSE(same(mesh, random_delaunay_mesh(1000, 8, options)));
}

TEST_CASE("the first vertices of a seed are the documented bits of the 64-bit Mersenne twister") {
  // The standard fixes the generator: its 10000th value from the default seed 5489 is 9981545732273789042.
  const RandomMesh mesh = random_delaunay_mesh(10000, 5489);
  CHECK(mesh.points.back().x == std::ldexp(static_cast<double>(9981545732273789042U >> 34), -30));
  CHECK(mesh.points.back().y == std::ldexp(static_cast<double>(9981545732273789042U >> 4 & 0x3fffffffU), -30));
}

TEST_CASE("vertices of a tiled mesh are numbered without regard to their place") {
  const RandomMesh mesh =
      random_delaunay_mesh(4000, 9, {GENERATE(GeneratedBoundary::random, GeneratedBoundary::resolved), 1000});
  double distance = 0;
  for (std::size_t i = 1; i < mesh.points.size(); ++i) {
    distance += std::sqrt(squared_length(mesh.points[i] - mesh.points[i - 1]));
  }
  // The mean distance of two random points of the unit square is 0.5214.
  CHECK(distance / static_cast<double>(mesh.points.size() - 1) == Approx(0.5214).margin(0.02));
}

TEST_CASE("mirrored tiles fill the unit square, conform, and come close to the number of vertices asked for") {
  const auto [vertices, tiles_per_side] =
      GENERATE(std::pair{301, 2}, std::pair{1000, 2}, std::pair{1201, 4}, std::pair{5003, 8}, std::pair{50000, 16});
  const GeneratedBoundary boundary_kind = GENERATE(GeneratedBoundary::random, GeneratedBoundary::resolved);
  CAPTURE(vertices, boundary_kind);
  const RandomMesh mesh = random_delaunay_mesh(vertices, 3, {boundary_kind, 300});
  CHECK(std::abs(static_cast<double>(mesh.points.size()) - vertices) <= tiles_per_side * tiles_per_side / 2.0);
  check_conforming(mesh);

  // Coordinates are multiples of 2^-33 at most and areas below 1, so the sum is exact in units of 2^-66.
  __extension__ unsigned __int128 area = 0;
  for (const auto& t : mesh.triangles) {
    const auto unit = [&](std::int32_t v) {
      const Point2<double> p = mesh.points[v];
      return std::pair{std::llround(std::ldexp(p.x, 33)), std::llround(std::ldexp(p.y, 33))};
    };
    __extension__ using Int128 = __int128;
    const auto [ax, ay] = unit(t[0]);
    const auto [bx, by] = unit(t[1]);
    const auto [cx, cy] = unit(t[2]);
    area += Int128{bx - ax} * (cy - ay) - Int128{by - ay} * (cx - ax);
  }
  CHECK(area >> 66 == 2);
  CHECK((area & ((__extension__ static_cast<unsigned __int128>(1) << 66) - 1)) == 0);

  const auto boundary = boundary_edges(mesh);
  for (const auto& [from, to] : boundary) {
    const Point2<double> a = mesh.points[from];
    const Point2<double> b = mesh.points[to];
    CHECK(((a.x == b.x && (a.x == 0 || a.x == 1)) || (a.y == b.y && (a.y == 0 || a.y == 1))));
  }
  CHECK(mesh.triangles.size() == 2 * mesh.points.size() - 2 - boundary.size());
}

TEST_CASE("a resolved boundary is the unit square, cut into edges of one length") {
  const auto [vertices, largest_tile] = GENERATE(table<std::int64_t, std::int64_t>(
      {{4, 300}, {8, 300}, {9, 300}, {25, 300}, {1000, 1000}, {20000, 1 << 22}, {1000, 300}, {5003, 300}}));
  CAPTURE(vertices, largest_tile);
  const RandomMesh mesh = random_delaunay_mesh(vertices, 5, {GeneratedBoundary::resolved, largest_tile});
  const bool is_tiled = vertices > largest_tile;
  if (!is_tiled) {
    CHECK(static_cast<std::int64_t>(mesh.points.size()) == vertices);
  }
  check_conforming(mesh);

  std::vector<double> lengths;
  for (const auto& [from, to] : boundary_edges(mesh)) {
    const Point2<double> a = mesh.points[from];
    const Point2<double> b = mesh.points[to];
    CHECK(((a.x == b.x && (a.x == 0 || a.x == 1)) || (a.y == b.y && (a.y == 0 || a.y == 1))));
    lengths.push_back(std::abs(a.x - b.x) + std::abs(a.y - b.y));
  }
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  CHECK(*longest - *shortest <= std::ldexp(1.0, -29));
  // Edges of one length that are no further apart than points inside would be: a grid's of as many vertices, or, where
  // each side holds a whole number of tiles, somewhat longer.
  const double edges_a_side = static_cast<double>(lengths.size()) / 4;
  CHECK(edges_a_side <= std::sqrt(static_cast<double>(vertices)) - 1);
  CHECK(edges_a_side > (std::sqrt(static_cast<double>(vertices)) - 2) * (is_tiled ? 0.7 : 1));

  const double spacing = 1 / edges_a_side;
  for (const Point2<double> p : mesh.points) {
    const double distance = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
    CHECK((distance == 0 || distance >= spacing / 5));
  }
}

TEST_CASE("lines between tiles are like a resolved boundary") {
  const RandomMesh mesh = random_delaunay_mesh(4000, 6, {GeneratedBoundary::resolved, 1000});
  const double spacing = 4.0 / static_cast<double>(boundary_edges(mesh).size());
  std::vector<double> on_line;
  for (const Point2<double> p : mesh.points) {
    CHECK((p.x == 0.5 || std::abs(p.x - 0.5) >= spacing / 5));
    CHECK((p.y == 0.5 || std::abs(p.y - 0.5) >= spacing / 5));
    if (p.x == 0.5) {
      on_line.push_back(p.y);
    }
  }
  std::sort(on_line.begin(), on_line.end());
  CHECK(static_cast<double>(on_line.size()) == 1 / spacing + 1);
  for (std::size_t i = 1; i < on_line.size(); ++i) {
    CHECK(on_line[i] - on_line[i - 1] == Approx(spacing).margin(1e-8));
  }
}

TEST_CASE("a mesh with a resolved boundary is Delaunay") {
  const RandomMesh mesh = random_delaunay_mesh(GENERATE(9, 100, 5000), 8, {GeneratedBoundary::resolved});
  const auto on_grid = [&](std::int32_t v) {
    return GridPoint{static_cast<std::int32_t>(std::ldexp(mesh.points[v].x, 29)),
                     static_cast<std::int32_t>(std::ldexp(mesh.points[v].y, 29))};
  };
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> opposite;  // of the directed edge
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      opposite[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    }
  }
  for (const auto& [edge, apex] : opposite) {
    const auto other = opposite.find({edge.second, edge.first});
    if (other != opposite.end()) {
      // Of every edge, the circle of one side is empty of the other: by Delaunay's lemma no circle holds any vertex.
      CHECK_FALSE(
          trismooth::in_circle(on_grid(edge.first), on_grid(edge.second), on_grid(apex), on_grid(other->second)));
    }
  }
}

TEST_CASE("the points inside a resolved boundary are spread evenly") {
  const RandomMesh mesh = random_delaunay_mesh(60000, 9, {GeneratedBoundary::resolved});
  std::array<int, 16> in_cell{};
  for (const Point2<double> p : mesh.points) {
    ++in_cell[static_cast<std::size_t>(std::min(p.x, 0.999) * 4) * 4 +
              static_cast<std::size_t>(std::min(p.y, 0.999) * 4)];
  }
  for (const int count : in_cell) {
    CHECK(count == Approx(3750).margin(350));
  }
}

TEST_CASE("the boundary of random points is coarser than the inside, a resolved one is not") {
  for (const std::int64_t vertices : {500, 2000, 20000}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      CAPTURE(vertices, seed);
      for (const auto boundary : {GeneratedBoundary::random, GeneratedBoundary::resolved}) {
        const RandomMesh mesh = random_delaunay_mesh(vertices, seed, {boundary});
        std::vector<std::uint8_t> held(mesh.points.size(), 0);
        for (const auto& [from, to] : boundary_edges(mesh)) {
          held[from] = held[to] = trismooth::hold::boundary;
        }
        CHECK(trismooth::find_coarse_boundary({mesh.points, mesh.triangles, {}, 0}, held).any() ==
              (boundary == GeneratedBoundary::random));
      }
    }
  }
}

TEST_CASE("a random boundary's meshes have the bits that they always had") {
  // Hashes (FNV-1a of coordinates and triangles) of the first version's.
  const auto hash_of = [](const RandomMesh& mesh) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&](std::int64_t number) { hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x100000001b3U; };
    for (const Point2<double> p : mesh.points) {
      add(std::llround(std::ldexp(p.x, 33)));
      add(std::llround(std::ldexp(p.y, 33)));
    }
    for (const auto& t : mesh.triangles) {
      std::for_each(t.begin(), t.end(), add);
    }
    return hash;
  };
  CHECK(hash_of(random_delaunay_mesh(4, 1)) == 0x4001647caf880a30U);
  CHECK(hash_of(random_delaunay_mesh(5000, 2)) == 0x84b6a639891a69edU);
  CHECK(hash_of(random_delaunay_mesh(5000, 3, {.largest_tile = 300})) == 0x2a38c6422a5e0f05U);
}

TEST_CASE("numbers of vertices that no mesh can have are refused") {
  for (const std::int64_t vertices : {std::int64_t{-1}, std::int64_t{0}, std::int64_t{3},
                                      trismooth::max_random_mesh_vertices + 1, std::int64_t{1} << 62}) {
    CHECK_THROWS_AS(random_delaunay_mesh(vertices, 1), std::invalid_argument);
  }
  CHECK_THROWS_AS(random_delaunay_mesh(1000, 1, {.largest_tile = 255}), std::invalid_argument);
  CHECK_THROWS_AS(random_delaunay_mesh(1000, 1, {.largest_tile = std::int64_t{1} << 27}), std::invalid_argument);
}

}  // namespace trismooth::random_mesh_test

#include "trismooth/smoothing/rings/triangle_topology.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Random;
using trismooth::connect_triangles;
using trismooth::MeshError;
using trismooth::orient;
using trismooth::Orientation;
using trismooth::Triangle;
using trismooth::TriangleTopology;
using trismooth::Workers;

namespace hold = trismooth::hold;

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(const Triangle& t, std::int32_t i) {
  const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
  return {low, high};
}

/// What topology must be, from a map of edges and walks over it.
class Oracle {
 public:
  Oracle(std::int32_t vertex_count, const std::vector<Triangle>& triangles)
      : vertex_count_(vertex_count), triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::int32_t i = 0; i < 3; ++i) {
        halfedges_[edge_of(triangles[t], i)].push_back(3 * static_cast<std::int32_t>(t) + i);
      }
    }
  }

  std::int32_t twin(std::int32_t halfedge) const {
    const auto& on_edge = halfedges_.at(edge_of(triangles_[halfedge / 3], halfedge % 3));
    if (on_edge.size() == 1) {
      return TriangleTopology::no_twin;
    }
    if (on_edge.size() > 2) {
      return TriangleTopology::many_twins;
    }
    return on_edge[0] == halfedge ? on_edge[1] : on_edge[0];
  }

  /// Component and parity of each triangle by breadth-first search; none where a component cannot be oriented.
  struct Components {
    std::vector<std::int32_t> component;
    std::vector<std::uint8_t> parity;
    std::int32_t count = 0;
  };
  std::optional<Components> components() const {
    Components found{std::vector<std::int32_t>(triangles_.size(), -1), std::vector<std::uint8_t>(triangles_.size(), 0)};
    for (std::size_t start = 0; start < triangles_.size(); ++start) {
      if (found.component[start] >= 0) {
        continue;
      }
      found.component[start] = found.count;
      std::deque<std::int32_t> queue{static_cast<std::int32_t>(start)};
      for (; !queue.empty(); queue.pop_front()) {
        const std::int32_t t = queue.front();
        for (std::int32_t i = 0; i < 3; ++i) {
          const std::int32_t other = twin(3 * t + i);
          if (other < 0) {
            continue;
          }
          const bool same_direction = triangles_[t][i] == triangles_[other / 3][other % 3];
          const auto parity = static_cast<std::uint8_t>(found.parity[t] ^ (same_direction ? 1 : 0));
          if (found.component[other / 3] < 0) {
            found.component[other / 3] = found.count;
            found.parity[other / 3] = parity;
            queue.push_back(other / 3);
          } else if (found.parity[other / 3] != parity) {
            return std::nullopt;
          }
        }
      }
      ++found.count;
    }
    return found;
  }

  std::uint8_t hold_of(std::int32_t vertex) const {
    std::set<std::int32_t> unseen;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (std::ranges::count(triangles_[t], vertex) > 0) {
        unseen.insert(static_cast<std::int32_t>(t));
      }
    }
    unsigned bits = unseen.empty() ? hold::isolated : 0U;
    for (const auto& [edge, on_edge] : halfedges_) {
      if (edge.first == vertex || edge.second == vertex) {
        bits |= on_edge.size() == 1 ? hold::boundary : 0U;
        bits |= on_edge.size() > 2 ? hold::non_manifold : 0U;
      }
    }
    int fans = 0;
    for (; !unseen.empty(); ++fans) {
      std::deque<std::int32_t> queue{*unseen.begin()};
      unseen.erase(unseen.begin());
      for (; !queue.empty(); queue.pop_front()) {
        for (std::int32_t i = 0; i < 3; ++i) {
          const Edge edge = edge_of(triangles_[queue.front()], i);
          const std::int32_t other = twin(3 * queue.front() + i);
          if ((edge.first == vertex || edge.second == vertex) && other >= 0 && unseen.erase(other / 3) > 0) {
            queue.push_back(other / 3);
          }
        }
      }
    }
    return static_cast<std::uint8_t>(bits | (fans > 1 ? hold::bow_tie : 0U));
  }

  void check(const TriangleTopology& topology) const {
    const auto expected = components();
    REQUIRE(expected);
    CHECK(topology.component == expected->component);
    CHECK(topology.parity == expected->parity);
    CHECK(topology.components == expected->count);
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(topology.twins.size()); ++h) {
      REQUIRE(topology.twins[h] == twin(h));
    }
    for (std::int32_t v = 0; v < vertex_count_; ++v) {
      CAPTURE(v);
      REQUIRE(int{topology.hold[v]} == int{hold_of(v)});
      std::vector<std::int32_t> corners;
      for (std::size_t h = 0; h < topology.twins.size(); ++h) {
        if (triangles_[h / 3][h % 3] == v) {
          corners.push_back(static_cast<std::int32_t>(h));
        }
      }
      REQUIRE(topology.degree[v] == static_cast<std::int32_t>(corners.size()));
      REQUIRE(topology.corner[v] == (corners.empty() ? -1 : corners.front()));
    }
  }

 private:
  std::int32_t vertex_count_;
  const std::vector<Triangle>& triangles_;
  std::map<Edge, std::vector<std::int32_t>> halfedges_;
};

/// Random triangles, or some of the ten of the projective plane with six vertices: hard to tell whether what is left of
/// it can be oriented.
std::vector<Triangle> random_triangles(std::int32_t& vertices, Random& random) {
  if (random.below(4) > 0) {
    return test_meshes::random_soup(vertices, random.below(16), random);
  }
  vertices = 6;
  std::vector<Triangle> plane{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                              {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  random.shuffle(plane);
  plane.resize(3 + static_cast<std::size_t>(random.below(8)));
  for (Triangle& t : plane) {
    random.shuffle(t);
  }
  return plane;
}

TriangleTopology connect(const Mesh& mesh, int threads = 1) {
  Workers workers(threads);
  return connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
}

Orientation oriented(const Mesh& mesh) {
  return orient(connect(mesh), mesh.triangles, mesh.points);
}

template <class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "no MeshError";
}

}  // namespace

TEST_CASE("twins, components, parities and hold bits of random triangle soups are those of a brute-force search") {
  Random random(1);
  Workers workers(1);
  int refused = 0;
  int accepted = 0;
  unsigned seen = 0;
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    std::int32_t vertices = 3 + random.below(12);
    const std::vector<Triangle> soup = random_triangles(vertices, random);
    const Oracle oracle(vertices, soup);
    if (!oracle.components()) {
      ++refused;
      REQUIRE_THROWS_AS(connect_triangles(vertices, soup, workers), MeshError);
      continue;
    }
    ++accepted;
    const TriangleTopology topology = connect_triangles(vertices, soup, workers);
    oracle.check(topology);
    for (const std::uint8_t bits : topology.hold) {
      seen |= bits;
    }
  }
  // Otherwise the soups prove nothing.
  CHECK(refused > 100);
  CHECK(accepted > 1000);
  CHECK(seen == (hold::boundary | hold::non_manifold | hold::bow_tie | hold::isolated));
}

TEST_CASE("topology of real meshes, listed in mixed orientation, is that of a brute-force search") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const Mesh mixed = test_meshes::partly_reversed(mesh, 3);
    Oracle(mixed.vertex_count(), mixed.triangles).check(connect(mixed));
  }
}

TEST_CASE("topology is the same for every number of threads") {
  const Mesh mesh =
      test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::jittered_grid(150, 150, 0.3, 1), 2), 5);
  const TriangleTopology one = connect(mesh);
  for (const int threads : {2, 3, 8}) {
    CAPTURE(threads);
    const TriangleTopology many = connect(mesh, threads);
    CHECK(many.twins == one.twins);
    CHECK(many.parity == one.parity);
    CHECK(many.component == one.component);
    CHECK(many.hold == one.hold);
    CHECK(many.corner == one.corner);
    CHECK(many.degree == one.degree);
  }
}

TEST_CASE("a grid's rim is boundary and its inside is held by nothing") {
  const Mesh mesh = test_meshes::jittered_grid(5, 4, 0, 1);
  const TriangleTopology topology = connect(mesh);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool inside = v % 5 > 0 && v % 5 < 4 && v / 5 > 0 && v / 5 < 3;
    CHECK(int{topology.hold[v]} == (inside ? 0 : int{hold::boundary}));
  }
}

TEST_CASE("bow-tie vertices, non-manifold edges and isolated vertices are told apart") {
  CHECK(connect(test_meshes::bow_tie()).hold == std::vector<std::uint8_t>{1, 1, 1 | hold::bow_tie, 1, 1});
  CHECK(connect(test_meshes::bow_tie()).components == 2);

  // Vertices 0 and 1 are ends of boundary edges as well, and of three fans of one triangle each.
  const auto ends = static_cast<std::uint8_t>(hold::boundary | hold::non_manifold | hold::bow_tie);
  CHECK(connect(test_meshes::three_on_an_edge()).hold == std::vector<std::uint8_t>{ends, ends, 1, 1, 1});
  CHECK(connect(test_meshes::three_on_an_edge()).components == 3);

  Mesh mesh = test_meshes::star(4);
  mesh.points.push_back({9, 9});
  CHECK(connect(mesh).hold == std::vector<std::uint8_t>{0, 1, 1, 1, 1, hold::isolated});
  CHECK(connect({{{0, 0}, {1, 1}}, {}}).hold == std::vector<std::uint8_t>{hold::isolated, hold::isolated});
  CHECK(connect({}).hold.empty());
}

TEST_CASE("a Moebius band is refused, in any order, whatever else is in the mesh") {
  for (std::int32_t length = 3; length < 9; ++length) {
    const Mesh band = test_meshes::moebius_band(length);
    CHECK_THROWS_AS(connect(band), MeshError);
    CHECK_THROWS_AS(connect(test_meshes::shuffled(band, 1)), MeshError);
    CHECK_THROWS_AS(connect(test_meshes::partly_reversed(band, 2)), MeshError);
    CHECK_THROWS_AS(connect(test_meshes::together(test_meshes::star(5), band, {3, 3})), MeshError);
  }
}

TEST_CASE("triangles with an index out of range or a vertex twice are refused, and the message says which") {
  const auto with = [](Triangle triangle) {
    Mesh mesh = test_meshes::star(4);
    mesh.triangles.push_back(triangle);
    return message_of([&] { static_cast<void>(connect(mesh)); });
  };
  CHECK(with({0, 1, 5}) == "triangle 4 names vertex 5 of 5");
  CHECK(with({-1, 1, 2}) == "triangle 4 names vertex -1 of 5");
  CHECK(with({1, 2147483647, 2}) == "triangle 4 names vertex 2147483647 of 5");
  CHECK(with({1, 1, 2}) == "triangle 4 repeats a vertex");
  CHECK(with({1, 2, 1}) == "triangle 4 repeats a vertex");
  CHECK(with({2, 1, 1}) == "triangle 4 repeats a vertex");
  CHECK(message_of([] { static_cast<void>(connect(test_meshes::moebius_band(4))); }).find("cannot be oriented") !=
        std::string::npos);
}

TEST_CASE("mixed orientation is undone: exactly the reversed triangles are found") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    if (name == "no free vertex" || name == "hopelessly tangled") {
      continue;  // three components of one triangle each; one with more inverted triangles than valid ones
    }
    for (const std::size_t period : {2U, 3U, 7U}) {
      CAPTURE(period);
      const Mesh mixed = test_meshes::partly_reversed(mesh, period);
      const Orientation found = oriented(mixed);
      for (std::size_t t = 0; t < mixed.triangles.size(); ++t) {
        REQUIRE(int{found.reversed[t]} == (t % period == 0 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("reoriented triangles are those listed against the majority of their component") {
  const Mesh grid = test_meshes::jittered_grid(4, 4, 0.2, 1);  // 18 triangles
  CHECK(oriented(grid).reoriented_triangles == 0);
  CHECK(oriented(test_meshes::partly_reversed(grid, 6)).reoriented_triangles == 3);
  CHECK(oriented(test_meshes::partly_reversed(grid, 1)).reoriented_triangles == 0);
  CHECK(oriented(test_meshes::partly_reversed(grid, 1)).reversed == std::vector<std::uint8_t>(18, 1));
  // Three of 18, then all of the second component: none of them is against its component.
  Mesh two =
      test_meshes::together(test_meshes::partly_reversed(grid, 6), test_meshes::partly_reversed(grid, 1), {5, 0});
  CHECK(oriented(two).reoriented_triangles == 3);
}

TEST_CASE("the sign of a component comes from the number of its triangles, not from their area") {
  // A large inverted triangle against two small valid ones: 0 1 2 and 1 0 3 on one edge, and 1 3 4.
  const Mesh mesh{{{0, 0}, {1, 0}, {0.5, -100}, {0.5, -0.1}, {1.2, -0.1}}, {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}}};
  const TriangleTopology topology = connect(mesh);
  REQUIRE(topology.parity == std::vector<std::uint8_t>{0, 0, 0});
  REQUIRE(topology.components == 1);
  const Orientation listed = orient(topology, mesh.triangles, mesh.points);
  CHECK(listed.reversed == std::vector<std::uint8_t>{0, 0, 0});
  const Mesh mirrored = test_meshes::partly_reversed(mesh, 1);
  CHECK(oriented(mirrored).reversed == std::vector<std::uint8_t>{1, 1, 1});
}

TEST_CASE("of as many triangles of either sign, the lowest one that is not degenerate is positive") {
  // Both hang below the edge from 0 to 1 where one should be above.
  const std::vector<test_meshes::Point> points{{0, 0}, {1, 0}, {0.5, -2}, {0.4, -1}, {9, 9}};
  CHECK(oriented({points, {{0, 1, 2}, {1, 0, 3}}}).reversed == std::vector<std::uint8_t>{1, 1});
  CHECK(oriented({points, {{1, 0, 3}, {0, 1, 2}}}).reversed == std::vector<std::uint8_t>{0, 0});
  // A degenerate triangle that comes first has no say: it hangs on the edge from 0 to 2 of the one listed clockwise.
  std::vector<test_meshes::Point> more = points;
  more.push_back({0.25, -1});
  const Mesh mesh{more, {{2, 0, 5}, {0, 1, 2}, {1, 0, 3}}};
  REQUIRE(connect(mesh).components == 1);
  REQUIRE(connect(mesh).parity == std::vector<std::uint8_t>{0, 1, 1});
  CHECK(oriented(mesh).reversed == std::vector<std::uint8_t>{0, 1, 1});
}

TEST_CASE("the sign of a nearly degenerate triangle is that of its quality, whichever corner is listed first") {
  // Along a line that no coordinate hits: the first triangle's doubled area is rounded to 0 from one corner on, and to
  // something else from the others on.
  const std::vector<test_meshes::Point> points{{0.016560048004348522, 0.3893983359162275},
                                               {-0.008405357178249775, -0.19764629288106597},
                                               {-0.006412872150660632, -0.15079435417427756},
                                               {0.004771384277554824, 0.11219587631683277}};
  const Mesh star{points, {{1, 2, 3}, {1, 3, 0}, {0, 3, 2}}};
  const Orientation expected = oriented(star);
  int positive = 0;
  int negative = 0;
  for (std::size_t t = 0; t < star.triangles.size(); ++t) {
    const auto [a, b, c] = trismooth::canonical_corners(star.triangles[t], expected.reversed[t] != 0);
    const double shape = trismooth::shape(points[a], points[b], points[c]);
    positive += shape > 0 ? 1 : 0;
    negative += shape < 0 ? 1 : 0;
  }
  CHECK(positive >= negative);
  for (int turn = 0; turn < 27; ++turn) {
    Mesh turned = star;
    for (int t = 0, turns = turn; t < 3; ++t, turns /= 3) {
      std::rotate(turned.triangles[t].begin(), turned.triangles[t].begin() + turns % 3, turned.triangles[t].end());
    }
    CAPTURE(turn);
    CHECK(oriented(turned).reversed == expected.reversed);
  }
}

TEST_CASE("a component of degenerate triangles alone keeps the order of its lowest triangle") {
  const Mesh mesh{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {{0, 1, 2}, {1, 2, 3}}};
  CHECK(oriented(mesh).reversed == std::vector<std::uint8_t>{0, 1});
}

TEST_CASE("corners are walked around a vertex both ways") {
  const Mesh mesh = test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::star(7), 3), 2);
  const TriangleTopology topology = connect(mesh);
  const Orientation orientation = oriented(mesh);
  for (std::int32_t h = 0; h < 21; ++h) {
    const std::int32_t next = next_corner(topology, mesh.triangles, orientation.reversed, h);
    if (next >= 0) {
      CHECK(mesh.triangles[next / 3][next % 3] == mesh.triangles[h / 3][h % 3]);
      CHECK(previous_corner(topology, mesh.triangles, orientation.reversed, next) == h);
    }
  }
}

TEST_CASE("numbers of vertices and triangles that no mesh has are refused") {
  CHECK_NOTHROW(trismooth::check_mesh_size(0, 0));
  CHECK_NOTHROW(trismooth::check_mesh_size(1, 715827882));
  CHECK_NOTHROW(trismooth::check_mesh_size(2147483647, 1));
  CHECK_THROWS_AS(trismooth::check_mesh_size(2147483648, 1), trismooth::MeshError);
  CHECK_THROWS_AS(trismooth::check_mesh_size(std::int64_t{1} << 32, 0), trismooth::MeshError);
  CHECK_THROWS_AS(trismooth::check_mesh_size(1, std::int64_t{1} << 33), trismooth::MeshError);
  CHECK_THROWS_AS(trismooth::check_mesh_size(-1, 0), trismooth::MeshError);
  CHECK_THROWS_AS(trismooth::check_mesh_size(1, -1), trismooth::MeshError);
  CHECK_THROWS_AS(trismooth::check_mesh_size(1, 715827883), trismooth::MeshError);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/triangle_topology.h"

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
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Random;
using trismooth::connect_triangles;
using trismooth::MeshError;
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
    if (on_edge.size() > 2 || are_copies(on_edge)) {
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
        bits |= on_edge.size() > 2 || are_copies(on_edge) ? hold::non_manifold : 0U;
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
  /// Whether the first two halfedges are of triangles with the same corners.
  bool are_copies(const std::vector<std::int32_t>& halfedges) const {
    return halfedges.size() > 1 &&
           std::ranges::is_permutation(triangles_[halfedges[0] / 3], triangles_[halfedges[1] / 3]);
  }

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
    return message_of<MeshError>([&] { static_cast<void>(connect(mesh)); });
  };
  CHECK(with({0, 1, 5}) == "triangle 4 names vertex 5; vertices are numbered from 0 to 4");
  CHECK(with({-1, 1, 2}) == "triangle 4 names vertex -1; vertices are numbered from 0 to 4");
  CHECK(with({1, 2147483647, 2}) == "triangle 4 names vertex 2147483647; vertices are numbered from 0 to 4");
  CHECK(with({1, 1, 2}) == "triangle 4 repeats a vertex");
  CHECK(with({1, 2, 1}) == "triangle 4 repeats a vertex");
  CHECK(with({2, 1, 1}) == "triangle 4 repeats a vertex");
  CHECK(message_of<MeshError>([] {
          static_cast<void>(connect(test_meshes::moebius_band(4)));
        }).find("cannot be oriented") != std::string::npos);
}

TEST_CASE("corners are walked around a vertex both ways") {
  const Mesh mesh = test_meshes::partly_reversed(test_meshes::shuffled(test_meshes::star(7), 3), 2);
  const TriangleTopology topology = connect(mesh);
  for (std::int32_t h = 0; h < 21; ++h) {
    const std::int32_t next = next_corner(topology, mesh.triangles, topology.parity, h);
    if (next >= 0) {
      CHECK(mesh.triangles[next / 3][next % 3] == mesh.triangles[h / 3][h % 3]);
      CHECK(previous_corner(topology, mesh.triangles, topology.parity, next) == h);
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

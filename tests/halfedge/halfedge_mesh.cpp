// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"

#include "catch.h"
#include "support/planar_samples.h"

using planar_samples::Sample;
using trismooth::ElementMesh;
using trismooth::HalfedgeMesh;
using trismooth::MeshError;
using trismooth::OneRings;
using trismooth::Orientation;
using trismooth::Triangle;
using trismooth::TriangleTopology;
using trismooth::Workers;

namespace {

struct Built {
  TriangleTopology topology;
  Orientation orientation;
  HalfedgeMesh halfedge;
};

Built build(const Sample& sample) {
  Workers workers(1);
  Built built;
  built.topology = trismooth::connect_triangles(sample.vertex_count(), sample.triangles, workers);
  std::vector<trismooth::Point2<double>> points;
  for (std::size_t i = 0; i < sample.xyz.size(); i += 3) {
    points.push_back({sample.xyz[i], sample.xyz[i + 1]});
  }
  built.orientation = trismooth::orient(built.topology, sample.triangles, points);
  TriangleTopology topology = built.topology;
  built.halfedge =
      trismooth::build_halfedge_mesh(sample.xyz, sample.triangles, topology, built.orientation.reversed, workers);
  return built;
}

/// The one-rings of these vertices, read from the halfedges.
OneRings read_rings(const Built& built, std::span<const std::uint8_t> fixed, Workers& workers) {
  return trismooth::one_rings(built.halfedge, built.topology.degree, fixed, {}, workers);
}

/// The triangle as the consistent orientation runs through it.
Triangle oriented(const Sample& sample, const Built& built, std::size_t t) {
  Triangle triangle = sample.triangles[t];
  if (built.orientation.reversed[t] != 0) {
    std::swap(triangle[1], triangle[2]);
  }
  return triangle;
}

Triangle smallest_first(Triangle triangle) {
  std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
  return triangle;
}

/// The input vertex of a vertex of the mesh.
std::int32_t original(const Sample& sample, const HalfedgeMesh& halfedge, std::int32_t vertex) {
  return vertex < sample.vertex_count() ? vertex : halfedge.copies_of[vertex - sample.vertex_count()];
}

/// Whether every handle fits to its neighbours', every boundary closes and every vertex is one fan.
bool is_consistent(const ElementMesh& mesh) {
  std::vector<int> leaving(mesh.n_vertices(), 0);
  for (const auto h : mesh.all_halfedges()) {
    const auto opposite = mesh.opposite_halfedge_handle(h);
    const auto next = mesh.next_halfedge_handle(h);
    if (opposite == h || mesh.opposite_halfedge_handle(opposite) != h || mesh.prev_halfedge_handle(next) != h ||
        mesh.next_halfedge_handle(mesh.prev_halfedge_handle(h)) != h ||
        mesh.to_vertex_handle(h) != mesh.from_vertex_handle(next) ||
        mesh.from_vertex_handle(h) != mesh.to_vertex_handle(opposite) ||
        mesh.from_vertex_handle(h) == mesh.to_vertex_handle(h) || mesh.face_handle(next) != mesh.face_handle(h)) {
      return false;
    }
    if (mesh.is_boundary(h) ? mesh.is_boundary(opposite)
                            : mesh.next_halfedge_handle(mesh.next_halfedge_handle(next)) != h) {
      return false;
    }
    ++leaving[static_cast<std::size_t>(mesh.from_vertex_handle(h).idx())];
  }
  for (const auto v : mesh.all_vertices()) {
    const auto first = mesh.halfedge_handle(v);
    int rotations = 0;
    bool boundary = false;
    if (first.is_valid()) {
      auto h = first;
      do {
        if (mesh.from_vertex_handle(h) != v) {
          return false;
        }
        boundary = boundary || mesh.is_boundary(h);
        h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
      } while (h != first && ++rotations <= leaving[static_cast<std::size_t>(v.idx())]);
      ++rotations;
      if (boundary && !mesh.is_boundary(first)) {
        return false;
      }
    }
    if (rotations != leaving[static_cast<std::size_t>(v.idx())]) {
      return false;
    }
  }
  return std::ranges::all_of(mesh.all_faces(), [&](auto f) { return mesh.face_handle(mesh.halfedge_handle(f)) == f; });
}

/// For each input vertex, into how many groups its triangles fall when those that share an edge at it, with no third
/// triangle there, are put together.
std::vector<int> fan_counts(const Sample& sample) {
  using Edge = std::pair<std::int32_t, std::int32_t>;
  std::map<Edge, std::vector<std::size_t>> on_edge;
  for (std::size_t t = 0; t < sample.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      on_edge[std::minmax(sample.triangles[t][i], sample.triangles[t][(i + 1) % 3])].push_back(t);
    }
  }
  std::vector<int> counts(sample.xyz.size() / 3, 0);
  for (const Triangle& triangle : sample.triangles) {
    for (const std::int32_t v : triangle) {
      ++counts[static_cast<std::size_t>(v)];
    }
  }
  // Each join of two groups at a vertex leaves one fewer; a closed fan has one edge more than it needs.
  std::map<std::pair<std::int32_t, std::size_t>, std::pair<std::int32_t, std::size_t>> parent;
  const auto root = [&](std::pair<std::int32_t, std::size_t> corner) {
    while (parent.contains(corner)) {
      corner = parent.at(corner);
    }
    return corner;
  };
  for (const auto& [edge, triangles] : on_edge) {
    for (const std::int32_t v : {edge.first, edge.second}) {
      if (triangles.size() == 2) {
        const auto a = root({v, triangles[0]});
        const auto b = root({v, triangles[1]});
        if (a != b) {
          parent[a] = b;
          --counts[static_cast<std::size_t>(v)];
        }
      }
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("the halfedge mesh built in bulk is consistent for every kind of mesh") {
  for (const Sample& sample : planar_samples::samples()) {
    CAPTURE(sample.name);
    const Built built = build(sample);
    CHECK(is_consistent(built.halfedge.mesh));
    CHECK(built.halfedge.mesh.n_faces() == sample.triangles.size());
    std::ostringstream complaints;
    CHECK(OpenMesh::Utils::MeshCheckerT<ElementMesh>(built.halfedge.mesh)
              .check(OpenMesh::Utils::MeshCheckerT<ElementMesh>::CHECK_ALL, complaints));
    CHECK(complaints.str().empty());
  }
}

TEST_CASE("face t is triangle t in its consistent orientation, and points are those of the input") {
  for (const Sample& sample : planar_samples::samples()) {
    CAPTURE(sample.name);
    const Built built = build(sample);
    const ElementMesh& mesh = built.halfedge.mesh;
    const std::vector<Triangle> faces = trismooth::face_list(mesh);
    REQUIRE(faces.size() == sample.triangles.size());
    for (std::size_t t = 0; t < faces.size(); ++t) {
      Triangle corners{};
      std::ranges::transform(faces[t], corners.begin(),
                             [&](std::int32_t v) { return original(sample, built.halfedge, v); });
      CHECK(smallest_first(corners) == smallest_first(oriented(sample, built, t)));
    }
    for (const auto v : mesh.all_vertices()) {
      const auto input = static_cast<std::size_t>(original(sample, built.halfedge, v.idx()));
      CHECK(mesh.point(v) ==
            Eigen::Vector3d(sample.xyz[3 * input], sample.xyz[3 * input + 1], sample.xyz[3 * input + 2]));
    }
  }
}

TEST_CASE("a vertex is there once for each fan of its triangles") {
  for (const Sample& sample : planar_samples::samples()) {
    CAPTURE(sample.name);
    const Built built = build(sample);
    const std::vector<int> fans = fan_counts(sample);
    std::vector<int> copies(fans.size(), 0);
    for (const std::int32_t v : built.halfedge.copies_of) {
      ++copies[static_cast<std::size_t>(v)];
    }
    REQUIRE(built.halfedge.mesh.n_vertices() == fans.size() + built.halfedge.copies_of.size());
    for (std::size_t v = 0; v < fans.size(); ++v) {
      CHECK(copies[v] == std::max(0, fans[v] - 1));
    }
    CHECK(built.halfedge.copies_of.empty() == sample.manifold);
  }
}

TEST_CASE("the bulk build gives the mesh that add_face gives") {
  for (const Sample& sample : planar_samples::samples()) {
    if (!sample.manifold) {
      continue;
    }
    CAPTURE(sample.name);
    const Built built = build(sample);
    const ElementMesh& mesh = built.halfedge.mesh;
    ElementMesh expected;
    for (std::size_t i = 0; i < sample.xyz.size(); i += 3) {
      expected.add_vertex({sample.xyz[i], sample.xyz[i + 1], sample.xyz[i + 2]});
    }
    for (std::size_t t = 0; t < sample.triangles.size(); ++t) {
      const auto [a, b, c] = oriented(sample, built, t);
      REQUIRE(expected.add_face(expected.vertex_handle(a), expected.vertex_handle(b), expected.vertex_handle(c))
                  .is_valid());
    }
    REQUIRE(mesh.n_vertices() == expected.n_vertices());
    REQUIRE(mesh.n_edges() == expected.n_edges());
    REQUIRE(mesh.n_faces() == expected.n_faces());
    for (const auto v : mesh.all_vertices()) {
      CHECK(mesh.valence(v) == expected.valence(v));
      CHECK(mesh.is_boundary(v) == expected.is_boundary(v));
      CHECK(mesh.is_isolated(v) == expected.is_isolated(v));
    }
    for (const auto h : mesh.all_halfedges()) {
      const auto same = expected.find_halfedge(mesh.from_vertex_handle(h), mesh.to_vertex_handle(h));
      REQUIRE(same.is_valid());
      CHECK(mesh.face_handle(h) == expected.face_handle(same));
      CHECK(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)) ==
            expected.to_vertex_handle(expected.next_halfedge_handle(same)));
    }
  }
}

TEST_CASE("one-rings read from the halfedge mesh are those read from the triangles") {
  std::mt19937_64 random(21);
  const bool some_named = GENERATE(false, true);
  for (const Sample& sample : planar_samples::samples()) {
    CAPTURE(sample.name);
    const Built built = build(sample);
    std::vector<std::uint8_t> named(sample.xyz.size() / 3, 0);
    std::ranges::generate(named, [&] { return some_named && random() % 4 == 0 ? std::uint8_t{1} : std::uint8_t{0}; });
    trismooth::Constraints constraints;
    constraints.fixed = named;
    const auto fixed = trismooth::fixed_vertices(built.topology, sample.triangles, constraints);
    for (const int threads : {1, 3}) {
      Workers workers(threads);
      const OneRings expected =
          trismooth::one_rings(built.topology, sample.triangles, built.orientation.reversed, fixed, workers);
      const OneRings rings = read_rings(built, fixed, workers);
      CHECK(rings.offsets == expected.offsets);
      CHECK(rings.neighbours == expected.neighbours);
    }
  }
}

TEST_CASE("one-rings of a large mesh do not depend on the number of threads") {
  std::mt19937_64 random(22);
  const Sample sample = planar_samples::shuffled(planar_samples::grid(150, 0.3, random), random);
  const Built built = build(sample);
  const auto fixed = trismooth::fixed_vertices(built.topology, sample.triangles, {});
  Workers one(1);
  const OneRings expected =
      trismooth::one_rings(built.topology, sample.triangles, built.orientation.reversed, fixed, one);
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    const OneRings rings = read_rings(built, fixed, workers);
    CHECK(rings.offsets == expected.offsets);
    CHECK(rings.neighbours == expected.neighbours);
  }
}

TEST_CASE("a mesh whose faces run clockwise gives the same one-rings, counter-clockwise") {
  std::mt19937_64 random(23);
  const Sample sample = planar_samples::shuffled(planar_samples::annulus(30, 6, random), random);
  const Built built = build(sample);
  const auto fixed = trismooth::fixed_vertices(built.topology, sample.triangles, {});
  Workers workers(1);
  const OneRings expected = read_rings(built, fixed, workers);

  const std::vector<std::uint8_t> turned(sample.triangles.size(), 1);
  TriangleTopology topology = built.topology;
  const HalfedgeMesh clockwise =
      trismooth::build_halfedge_mesh(sample.xyz, sample.triangles, topology, turned, workers);
  CHECK(is_consistent(clockwise.mesh));
  const OneRings rings = trismooth::one_rings(clockwise, built.topology.degree, fixed, turned, workers);
  CHECK(rings.offsets == expected.offsets);
  CHECK(rings.neighbours == expected.neighbours);
}

TEST_CASE("a halfedge mesh larger than OpenMesh's handles is refused") {
  // 3 T + boundary edges: a mesh of separate triangles has twice as many halfedges as corners.
  constexpr std::int64_t most = 2147483647;
  CHECK_NOTHROW(trismooth::check_halfedge_mesh_size(most, 715827882, 0));
  CHECK_NOTHROW(trismooth::check_halfedge_mesh_size(1, 357913941, std::int64_t{3} * 357913941));
  CHECK_THROWS_AS(trismooth::check_halfedge_mesh_size(1, 357913942, std::int64_t{3} * 357913942), MeshError);
  CHECK_THROWS_AS(trismooth::check_halfedge_mesh_size(1, 715827882, 2), MeshError);
  CHECK_THROWS_AS(trismooth::check_halfedge_mesh_size(most + 1, 1, 3), MeshError);
  CHECK_NOTHROW(trismooth::check_halfedge_mesh_size(1, 1, 0, 536870911));
  CHECK_THROWS_AS(trismooth::check_halfedge_mesh_size(1, 2, 0, 536870911), MeshError);
}

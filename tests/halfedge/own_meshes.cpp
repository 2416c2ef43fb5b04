// SPDX-License-Identifier: BSD-3-Clause
// smooth(mesh) of meshes with traits of other people.

#include "support/own_meshes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"

// The sources of this folder are compiled as one: what is named here is seen here alone.
namespace own_meshes {

using planar_samples::Sample;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Triangle;

namespace {

/// The shape of a triangle in space, without a sign.
template <class Mesh>
double worst_shape(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  double worst = 1;
  for (const Triangle& t : triangles) {
    std::array<Point3, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        corners[i][k] = static_cast<double>(mesh.point(OpenMesh::VertexHandle(t[i]))[k]);
      }
    }
    Point3 ab{};
    Point3 ac{};
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      ab[k] = corners[1][k] - corners[0][k];
      ac[k] = corners[2][k] - corners[0][k];
      squares += ab[k] * ab[k] + ac[k] * ac[k] + (ac[k] - ab[k]) * (ac[k] - ab[k]);
    }
    const double doubled_area =
        std::hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]);
    worst = std::min(worst, 2 * std::numbers::sqrt3 * doubled_area / squares);
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("a mesh with traits of one's own is smoothed to the bits of the flat arrays", "", FloatMesh,
                   FullMesh, PairMesh, EigenMesh, NodeMesh, PolyMesh) {
  using Number = NumberOf<TestType>;
  SmoothingOptions options;
  options.form = GENERATE(trismooth::Form::swap, trismooth::Form::in_place);
  options.max_sweeps = 50;
  for (const Sample& sample : planar_samples::manifold_samples()) {
    CAPTURE(sample.name);
    std::vector<Number> xy = xy_of<Number>(sample);
    const SmoothingResult expected = trismooth::smooth(trismooth::xy_points(xy), sample.triangles, options);
    auto mesh = mesh_of<TestType>(sample);
    const auto before = mesh;
    const SmoothingResult result = trismooth::smooth(mesh, options);
    CHECK(xy_in(mesh) == xy);
    CHECK(result.sweeps == expected.sweeps);
    CHECK(result.moved_vertices == expected.moved_vertices);
    CHECK(result.free_vertices == expected.free_vertices);
    CHECK(result.inverted == expected.inverted);
    for (const auto v : mesh.vertices()) {
      if constexpr (numbers_of<TestType> == 3) {
        CHECK(mesh.point(v)[2] == before.point(v)[2]);
      }
    }
  }
}

TEST_CASE("what lies behind the numbers of a point stays as it is") {
  auto mesh = mesh_of<NodeMesh>(shuffled_grid(10, 2));
  for (const auto v : mesh.vertices()) {
    mesh.point(v).tag = 1000 + v.idx();
  }
  CHECK(trismooth::smooth(mesh).moved_vertices > 0);
  for (const auto v : mesh.vertices()) {
    CHECK(mesh.point(v).tag == 1000 + v.idx());
  }
}

TEST_CASE("target lengths, one a vertex of the mesh, steer as they do with flat arrays") {
  const Sample sample = shuffled_grid(12, 3);
  std::vector<double> lengths;
  for (std::size_t v = 0; v < sample.xyz.size() / 3; ++v) {
    lengths.push_back(0.7 + 0.05 * sample.xyz[3 * v]);
  }
  SmoothingOptions options;
  options.method = trismooth::Method::mean_ratio;
  auto without = mesh_of<FullMesh>(sample);
  trismooth::smooth(without, options);
  options.mean_ratio.target_lengths = lengths;
  std::vector<double> xy = sample.xy();
  trismooth::smooth(trismooth::xy_points(xy), sample.triangles, options);
  auto mesh = mesh_of<FullMesh>(sample);
  trismooth::smooth(mesh, options);
  CHECK(xy_in(mesh) == xy);
  CHECK(xy_in(mesh) != xy_in(without));
  lengths.pop_back();
  options.mean_ratio.target_lengths = lengths;
  CHECK_THROWS_AS(trismooth::smooth(mesh, options), std::invalid_argument);
}

TEST_CASE("what is locked or a feature is held: vertices, ends of edges and halfedges, corners of locked faces") {
  const Sample sample = shuffled_grid(14, 4);
  auto mesh = mesh_of<FullMesh>(sample);
  std::vector<std::uint8_t> held(mesh.n_vertices(), 0);
  const auto hold = [&](OpenMesh::VertexHandle v) { held[static_cast<std::size_t>(v.idx())] = 1; };
  const auto inner = [&](int from) {
    while (mesh.is_boundary(OpenMesh::VertexHandle(from))) {
      ++from;
    }
    return OpenMesh::VertexHandle(from);
  };
  const auto one = inner(10);
  const auto two = inner(30);
  mesh.status(one).set_locked(true);
  mesh.status(two).set_feature(true);
  hold(one);
  hold(two);
  int kind = 0;
  for (const int from : {50, 70, 90, 110}) {
    const auto h = mesh.halfedge_handle(inner(from));
    auto& status = kind < 2 ? mesh.status(mesh.edge_handle(h)) : mesh.status(h);
    kind % 2 == 0 ? status.set_locked(true) : status.set_feature(true);
    hold(mesh.from_vertex_handle(h));
    hold(mesh.to_vertex_handle(h));
    ++kind;
  }
  const OpenMesh::FaceHandle face(100);
  mesh.status(face).set_locked(true);
  for (const std::int32_t corner : sample.triangles[100]) {
    hold(OpenMesh::VertexHandle(corner));
  }
  // Marks that hold nothing.
  mesh.status(inner(130)).set_selected(true);
  mesh.status(inner(140)).set_tagged(true);
  mesh.status(OpenMesh::FaceHandle(20)).set_feature(true);

  std::vector<double> xy = sample.xy();
  const SmoothingResult expected =
      trismooth::smooth(trismooth::xy_points(xy), sample.triangles, trismooth::Constraints{.fixed = held});
  const SmoothingResult result = trismooth::smooth(mesh);
  CHECK(xy_in(mesh) == xy);
  CHECK(result.free_vertices == expected.free_vertices);
  CHECK(result.free_vertices < 13 * 13 - 8);
  CHECK(result.moved_vertices > 0);

  auto no_status = mesh_of<FloatMesh>(sample);
  CHECK(trismooth::smooth(no_status).free_vertices == 13 * 13);
}

TEST_CASE("deleted elements are passed over: a hole is a boundary, and nobody looks where a deleted vertex lies") {
  const Sample sample = shuffled_grid(14, 5);
  const bool is_tilted = GENERATE(false, true);
  const auto place = [&](const Point3& p) { return is_tilted ? tilted(p) : p; };
  auto mesh = mesh_of<FullMesh>(sample, place);
  int vertex = 100;
  while (mesh.is_boundary(OpenMesh::VertexHandle(vertex))) {
    ++vertex;
  }
  const OpenMesh::VertexHandle gone(vertex);
  mesh.delete_vertex(gone, false);
  mesh.delete_face(OpenMesh::FaceHandle(0), false);
  mesh.delete_face(OpenMesh::FaceHandle(77), false);
  // An edge of the hole is gone with its marks.
  for (const auto e : mesh.all_edges()) {
    const OpenMesh::EdgeHandle edge(e.idx());
    if (mesh.status(edge).deleted()) {
      mesh.status(edge).set_locked(true);
    }
  }
  Sample without = sample;  // the oracle: a mesh that never had these faces
  std::erase_if(without.triangles,
                [&, t = 0](const Triangle&) mutable { return mesh.status(OpenMesh::FaceHandle(t++)).deleted(); });
  auto never = mesh_of<FullMesh>(without, place);
  REQUIRE(never.n_faces() == without.triangles.size());
  REQUIRE(never.n_faces() < mesh.n_faces() - 4);
  const bool is_nan = GENERATE(false, true);
  const double far = is_nan ? std::bit_cast<double>(0x7ff4000000001234U) : 1e200;  // a signalling one, with a payload
  mesh.point(gone) = {far, -far, 5};
  const auto before = numbers_in(mesh);
  const auto known = all_but_points(mesh);

  const SmoothingResult expected = trismooth::smooth(never);
  const SmoothingResult result = trismooth::smooth(mesh);
  CHECK(result.moved_vertices == expected.moved_vertices);
  CHECK(result.free_vertices == expected.free_vertices);
  CHECK(result.sweeps == expected.sweeps);
  CHECK(result.moved_vertices > 0);
  CHECK(all_but_points(mesh) == known);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(std::bit_cast<std::uint64_t>(mesh.point(gone)[k]) ==
          std::bit_cast<std::uint64_t>(before[3 * static_cast<std::size_t>(vertex) + k]));
  }
  mesh.point(gone) = never.point(gone);
  CHECK(numbers_in(mesh) == numbers_in(never));
}

TEST_CASE("nothing of a mesh changes but its points") {
  const Sample sample = shuffled_grid(12, 6);
  const bool is_tilted = GENERATE(false, true);
  auto mesh = mesh_of<FullMesh>(sample, [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  OpenMesh::VPropHandleT<double> temperature;
  OpenMesh::FPropHandleT<std::string> names;
  mesh.add_property(temperature, "temperature");
  mesh.add_property(names, "names");
  mesh.update_normals();
  for (const auto v : mesh.vertices()) {
    mesh.data(v).bc = 3 * v.idx();
    mesh.property(temperature, v) = 0.5 * v.idx();
    mesh.status(v).set_selected(v.idx() % 3 == 0);
  }
  for (const auto f : mesh.faces()) {
    mesh.data(f).material = f.idx() % 4;
    mesh.property(names, f) = std::to_string(f.idx());
    mesh.status(f).set_tagged(f.idx() % 2 == 0);
  }
  auto before = mesh;
  CHECK(trismooth::smooth(mesh, {.regions = [&](auto f) { return mesh.data(f).material / 3; }}).moved_vertices > 0);
  CHECK(all_but_points(mesh) == all_but_points(before));
  CHECK(numbers_in(mesh) != numbers_in(before));
  for (const auto v : mesh.vertices()) {
    CHECK(mesh.data(v).bc == before.data(v).bc);
    CHECK(mesh.property(temperature, v) == before.property(temperature, v));
    CHECK(mesh.normal(v) == before.normal(v));
  }
  for (const auto f : mesh.faces()) {
    CHECK(mesh.data(f).material == before.data(f).material);
    CHECK(mesh.property(names, f) == before.property(names, f));
  }
}

TEST_CASE("in a tilted plane a mesh of one's own gets the bits that the mesh of this project gets") {
  for (const Sample& sample : planar_samples::manifold_samples()) {
    CAPTURE(sample.name);
    auto mesh = mesh_of<FullMesh>(sample, tilted);
    auto other = mesh_of<trismooth::TriangleMesh>(sample, tilted);
    const SmoothingResult expected = trismooth::smooth(other);
    const SmoothingResult result = trismooth::smooth(mesh);
    CHECK(numbers_in(mesh) == numbers_in(other));
    CHECK(result.moved_vertices == expected.moved_vertices);
  }
}

TEST_CASE("a tilted mesh of float stays in its plane to rounding, and its worst triangle gets no worse in space") {
  const Sample sample = shuffled_grid(14, 7);
  auto mesh = mesh_of<PolyMesh>(sample, tilted);
  const auto before = mesh;
  const SmoothingResult result = trismooth::smooth(mesh);
  CHECK(result.moved_vertices > 13 * 13 / 2);
  CHECK(worst_shape(mesh, sample.triangles) >= worst_shape(before, sample.triangles) - 1e-6);
  std::int64_t moved = 0;
  for (const auto v : mesh.vertices()) {
    const auto step = mesh.point(v) - before.point(v);
    moved += mesh.point(v) != before.point(v) ? 1 : 0;
    CHECK(std::abs(-0.36 * step[0] - 0.48 * step[1] + 0.8 * step[2]) < 1e-5);
  }
  CHECK(moved == result.moved_vertices);
}

TEST_CASE("what has been turned over is told by face, deleted ones counted") {
  std::mt19937_64 random(8);
  const Sample sample = planar_samples::grid(14, 0.2, random);
  auto mesh = mesh_of<FullMesh>(sample);
  mesh.delete_face(OpenMesh::FaceHandle(0), true);
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) {
      mesh.point(v)[0] = 14 - mesh.point(v)[0];
    }
  }
  SmoothingOptions options;
  options.untangle = trismooth::Untangle::on;
  const SmoothingResult result = trismooth::smooth(mesh, options);
  REQUIRE(result.untangling);
  REQUIRE(result.untangling->turned_components == 1);
  REQUIRE(result.untangling->turned.size() == mesh.n_faces());
  CHECK(result.untangling->turned[0] == 0);
  CHECK(std::count(result.untangling->turned.begin(), result.untangling->turned.end(), 1) ==
        static_cast<std::ptrdiff_t>(mesh.n_faces() - 1));
}

TEST_CASE("points that are no numbers, or in no plane, are refused, nothing is moved") {
  const Sample sample = shuffled_grid(6, 9);
  auto mesh = mesh_of<PolyMesh>(sample);
  int inner = 0;
  while (mesh.is_boundary(OpenMesh::VertexHandle(inner))) {
    ++inner;
  }
  const std::string named = "vertex " + std::to_string(inner) + " ";
  const auto before = numbers_in(mesh);
  const float good = mesh.point(OpenMesh::VertexHandle(inner))[2];
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 2.0F}) {
    mesh.point(OpenMesh::VertexHandle(inner))[2] = bad;
    CHECK_THROWS_AS(trismooth::smooth(mesh), trismooth::MeshError);
    CHECK(error_of([&] { trismooth::smooth(mesh); }).find(named) != std::string::npos);
    mesh.point(OpenMesh::VertexHandle(inner))[2] = good;
    CHECK(numbers_in(mesh) == before);
  }
}

}  // namespace own_meshes

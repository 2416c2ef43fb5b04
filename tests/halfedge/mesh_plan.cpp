// SPDX-License-Identifier: BSD-3-Clause
// plan(mesh) and quality(mesh).

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/mesh_io/halfedge/mesh_quality.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/own_meshes.h"

namespace own_meshes {

using planar_samples::Sample;
using trismooth::Metric;
using trismooth::QualityReport;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;

namespace {

/// Moves the inner points within their plane, `by` of the squares' size.
template <class Mesh>
void stir(Mesh& mesh, double by, bool is_tilted) {
  const Point3 along = is_tilted ? Point3{0.48, 0.64, 0.6} : Point3{1, 0, 0};
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) {
      for (std::size_t k = 0; k < numbers_of<Mesh>; ++k) {
        mesh.point(v)[k] += static_cast<NumberOf<Mesh>>(by * std::sin(v.idx()) * along[k]);
      }
    }
  }
}

void check_same(const QualityReport& found, const QualityReport& expected) {
  CHECK(found.triangles == expected.triangles);
  CHECK(found.inverted == expected.inverted);
  CHECK(found.degenerate == expected.degenerate);
  CHECK(found.shape_histogram == expected.shape_histogram);
  for (std::size_t m = 0; m < trismooth::all_metrics().size(); ++m) {
    CHECK(found.metrics[m].min == expected.metrics[m].min);
    CHECK(found.metrics[m].mean == expected.metrics[m].mean);
    CHECK(found.metrics[m].max == expected.metrics[m].max);
  }
  REQUIRE(found.worst.size() == expected.worst.size());
  for (std::size_t i = 0; i < found.worst.size(); ++i) {
    CHECK(found.worst[i].element == expected.worst[i].element);
    CHECK(found.worst[i].shape == expected.worst[i].shape);
    CHECK(found.worst[i].centroid == expected.worst[i].centroid);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("a plan over points that move gives what smooth() gives", "", FloatMesh, FullMesh, PairMesh,
                   trismooth::TriangleMesh) {
  const bool is_tilted = numbers_of<TestType> == 3 && GENERATE(false, true);
  const Sample sample = shuffled_grid(12, 31);
  auto mesh = mesh_of<TestType>(sample, [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  std::vector<std::int32_t> regions;
  for (const auto& t : sample.triangles) {
    regions.push_back(sample.xyz[3 * t[0]] < 5 ? 1 : 2);
  }
  SmoothingOptions options;
  options.form = trismooth::Form::in_place;
  auto plan = trismooth::plan(mesh, {.regions = regions}, options);
  for (int step = 0; step < 4; ++step) {
    stir(mesh, 0.3, is_tilted);
    auto other = mesh;
    const SmoothingResult expected = trismooth::smooth(other, {.regions = regions}, options);
    const SmoothingResult result = plan.smooth(mesh);
    CHECK(numbers_in(mesh) == numbers_in(other));
    CHECK(result.moved_vertices == expected.moved_vertices);
    CHECK(result.moved_vertices > 0);
    CHECK(result.sweeps == expected.sweeps);
    CHECK(result.inverted == expected.inverted);
  }
}

TEST_CASE("a plan follows a mesh out of the plane of two axes and back, and outlives the mesh that it was made of") {
  const Sample sample = shuffled_grid(12, 32);
  auto plan = [&] {
    const auto mesh = mesh_of<FullMesh>(sample);
    return trismooth::plan(mesh);
  }();
  for (const bool is_tilted : {true, false, true, false}) {
    const auto place = [&](const Point3& p) { return is_tilted ? tilted(p) : p; };
    auto mesh = mesh_of<FullMesh>(sample, place);
    auto other = mesh;
    trismooth::smooth(other);
    CHECK(plan.smooth(mesh).moved_vertices > 0);
    CHECK(numbers_in(mesh) == numbers_in(other));
  }
}

TEST_CASE("a plan says why it holds a vertex, in whatever plane, before the first smoothing and after it") {
  const Sample sample = shuffled_grid(12, 34);
  const bool is_tilted = GENERATE(false, true);
  auto mesh = mesh_of<FullMesh>(sample, [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  std::vector<std::int32_t> regions;
  for (const auto& t : sample.triangles) {
    regions.push_back(sample.xyz[3 * t[0]] < 5 ? 1 : 2);
  }
  FullMesh::VertexHandle locked;
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) {
      locked = v;
    }
  }
  mesh.status(locked).set_locked(true);
  auto plan = trismooth::plan(mesh, {.regions = regions});
  for (const bool is_smoothed : {false, true}) {
    INFO("smoothed: " << is_smoothed);
    const std::vector<std::uint8_t> reasons = plan.fixed();
    REQUIRE(reasons.size() == mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
      const unsigned why = reasons[static_cast<std::size_t>(v.idx())];
      std::set<std::int32_t> around;
      for (const auto face : mesh.vf_range(v)) {
        around.insert(regions[static_cast<std::size_t>(face.idx())]);
      }
      INFO("vertex " << v.idx());
      CHECK(((why & trismooth::hold::boundary) != 0) == mesh.is_boundary(v));
      CHECK(((why & trismooth::hold::interface) != 0) == (around.size() > 1));
      CHECK(((why & trismooth::hold::named) != 0) == (v == locked));
    }
    plan.smooth(mesh);
  }
  const auto moved = std::move(plan);
  CHECK_THROWS_AS(plan.fixed(), std::logic_error);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
}

TEST_CASE("what a function of the constraints calls has limits of its own, and none of the smoothing's") {
  const Sample sample = shuffled_grid(12, 35);
  auto mesh = mesh_of<FullMesh>(sample);
  auto other = mesh;
  SmoothingOptions unwanted;
  unwanted.cancel = [] { return true; };
  bool is_over = false;
  SmoothingOptions options;
  options.cancel = [&is_over] { return is_over; };
  int calls = 0;
  const auto fixed = [&](FullMesh::VertexHandle) {
    if (++calls == 1) {
      CHECK(trismooth::smooth(other, unwanted).stop_reason == trismooth::StopReason::cancelled);
      is_over = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));  // so that the next look asks
      CHECK(trismooth::quality(other).triangles == std::ssize(sample.triangles));
    }
    return false;
  };
  const auto result = trismooth::smooth(mesh, {.fixed = fixed}, options);
  CHECK(calls == static_cast<int>(mesh.n_vertices()));
  CHECK(result.stop_reason == trismooth::StopReason::cancelled);
}

TEST_CASE("a plan of which a component is turned over smooths it so") {
  const Sample sample = shuffled_grid(12, 33);
  const bool is_tilted = GENERATE(false, true);
  const auto mirrored = [&](const Point3& p) {
    const Point3 turned{-p[0], p[1], p[2]};
    return is_tilted ? tilted(turned) : turned;
  };
  auto mesh = mesh_of<FullMesh>(sample, [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  auto plan = trismooth::plan(mesh);
  plan.smooth(mesh);
  auto other = mesh_of<FullMesh>(sample, mirrored);
  auto expected = other;
  trismooth::smooth(expected);
  CHECK(plan.smooth(other).inverted == 0);
  CHECK(numbers_in(other) == numbers_in(expected));
}

TEST_CASE("a plan takes the locked vertices of the mesh that it was made of, and another mesh not at all") {
  const Sample sample = shuffled_grid(10, 34);
  auto mesh = mesh_of<FullMesh>(sample);
  for (const auto v : mesh.vertices()) {
    mesh.status(v).set_locked(true);
  }
  auto plan = trismooth::plan(mesh);
  for (const auto v : mesh.vertices()) {
    mesh.status(v).set_locked(false);
  }
  CHECK(plan.smooth(mesh).moved_vertices == 0);
  auto larger = mesh_of<FullMesh>(shuffled_grid(11, 34));
  const auto before = numbers_in(larger);
  CHECK_THROWS_AS(plan.smooth(larger), std::invalid_argument);
  CHECK(error_of([&] { plan.smooth(larger); }) ==
        "the mesh has 144 vertices and 242 faces, the plan is for one of 121 and 200, deleted ones counted");
  CHECK(numbers_in(larger) == before);

  const std::string other_faces = "the mesh has other faces than that of which the plan was made";
  auto flipped = mesh;
  for (const auto e : flipped.edges()) {
    if (flipped.is_flip_ok(e)) {
      flipped.flip(e);
      break;
    }
  }
  CHECK(error_of([&] { plan.smooth(flipped); }).starts_with(other_faces));
  auto without = mesh;
  without.delete_face(without.face_handle(7), false);
  CHECK(error_of([&] { plan.smooth(without); }).starts_with(other_faces));
  auto renumbered = mesh_of<FullMesh>(shuffled_grid(10, 35));
  CHECK(error_of([&] { plan.smooth(renumbered); }).starts_with(other_faces));

  trismooth::MeshPlan moved = std::move(plan);
  CHECK(moved.smooth(mesh).moved_vertices == 0);
  // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move): that is the question
  CHECK_THROWS_AS(plan.smooth(mesh), std::logic_error);
  STATIC_REQUIRE_FALSE(std::is_copy_constructible_v<trismooth::MeshPlan>);
}

TEST_CASE("a plan holds the layers of its first points, in whatever planes the later ones lie") {
  // Rows of right-angled triangles ten times as long as high, in which nothing else is held.
  Sample layered;
  const std::int32_t n = 12;
  for (std::int32_t j = 0; j <= n; ++j) {
    for (std::int32_t i = 0; i <= n; ++i) {
      layered.xyz.insert(layered.xyz.end(), {10.0 * i, 1.0 * j, 0.0});
    }
  }
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t v = j * (n + 1) + i;
      layered.triangles.push_back({v, v + 1, v + n + 2});
      layered.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  }
  const auto flat = [](const Point3& p) { return p; };
  const bool begins_tilted = GENERATE(false, true);
  auto mesh = begins_tilted ? mesh_of<FullMesh>(layered, tilted) : mesh_of<FullMesh>(layered, flat);
  auto plan = trismooth::plan(mesh);
  const auto first = plan.smooth(mesh);
  REQUIRE(first.layers.kept > 0);
  CHECK(first.moved_vertices == 0);
  // The rows are as high as long now, and stirred: by themselves they would be smoothed.
  std::mt19937_64 random(39);
  std::uniform_real_distribution<double> step(-0.3, 0.3);
  Sample square = layered;
  for (std::size_t v = 0; v < square.xyz.size(); v += 3) {
    square.xyz[v] = square.xyz[v] / 10 + (v / 3 % (n + 1) % n == 0 ? 0 : step(random));
  }
  for (const bool is_tilted : {begins_tilted, !begins_tilted, begins_tilted}) {
    auto later = is_tilted ? mesh_of<FullMesh>(square, tilted) : mesh_of<FullMesh>(square, flat);
    const auto before = numbers_in(later);
    const auto result = plan.smooth(later);
    CHECK(result.layers.kept == first.layers.kept);
    CHECK(numbers_in(later) == before);
    CHECK(trismooth::smooth(later).moved_vertices > 0);
  }
}

TEST_CASE("a plan made of points that are no numbers yet smooths them when they are") {
  const Sample sample = shuffled_grid(10, 35);
  const bool is_tilted = GENERATE(false, true);
  auto mesh = mesh_of<FullMesh>(sample, [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  auto unset = mesh;
  for (const auto v : unset.vertices()) {
    unset.point(v) = OpenMesh::Vec3d(std::nan(""));
  }
  auto plan = trismooth::plan(unset);
  CHECK_THROWS_AS(plan.smooth(unset), trismooth::MeshError);
  auto expected = mesh;
  trismooth::smooth(expected);
  plan.smooth(mesh);
  CHECK(numbers_in(mesh) == numbers_in(expected));
}

TEST_CASE("with a device a plan along two axes is prepared once, in other planes the rings are asked for every time") {
  const bool is_tilted = GENERATE(false, true);
  auto mesh = mesh_of<FullMesh>(shuffled_grid(10, 38), [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
  mesh.status(OpenMesh::VertexHandle(60)).set_locked(true);
  auto on_host = mesh;
  const fakes::FakeBackend device;
  SmoothingOptions options;
  options.backend = &device;
  options.topology = trismooth::Topology::device;
  auto plan = trismooth::plan(mesh, options);
  CHECK(device.rings_found == 0);
  for (int step = 0; step < 3; ++step) {
    stir(mesh, 0.3, is_tilted);
    stir(on_host, 0.3, is_tilted);
    CHECK(plan.smooth(mesh).backend == "cuda");
    trismooth::smooth(on_host);
    CHECK(numbers_in(mesh) == numbers_in(on_host));
  }
  CHECK(device.rings_found == (is_tilted ? 3 : 0));
  CHECK(device.prepared == (is_tilted ? 3 : 1));
}

TEMPLATE_TEST_CASE("the quality of a mesh with traits of one's own is that of its flat arrays", "", FloatMesh, FullMesh,
                   PairMesh, EigenMesh, NodeMesh, PolyMesh) {
  for (const Sample& sample : planar_samples::manifold_samples()) {
    CAPTURE(sample.name);
    auto mesh = mesh_of<TestType>(sample);
    for (const auto v : mesh.vertices()) {  // some are inverted
      if (!mesh.is_boundary(v) && v.idx() % 5 == 0) {
        mesh.point(v)[0] += NumberOf<TestType>{1};
      }
    }
    const auto xy = xy_in(mesh);
    const QualityReport expected = trismooth::quality(trismooth::xy_points(xy), sample.triangles);
    check_same(trismooth::quality(std::as_const(mesh)), expected);
    CHECK(trismooth::quality(mesh, {.worst_count = 3}).worst.size() ==
          std::min<std::size_t>(3, sample.triangles.size()));
  }
}

TEST_CASE("the quality along other axes is that of the two, in a tilted plane nearly that of the flat mesh") {
  const Sample sample = shuffled_grid(12, 36);
  const std::vector<double> xy = sample.xy();
  const QualityReport flat = trismooth::quality(trismooth::xy_points(xy), sample.triangles);
  check_same(trismooth::quality(mesh_of<FullMesh>(sample,
                                                  [](const Point3& p) {
                                                    return Point3{p[0], 7, p[1]};
                                                  })),
             flat);
  check_same(trismooth::quality(mesh_of<FullMesh>(sample,
                                                  [](const Point3& p) {
                                                    return Point3{7, p[0], p[1]};
                                                  })),
             flat);
  const QualityReport report = trismooth::quality(mesh_of<FullMesh>(sample, tilted));
  CHECK(report.triangles == flat.triangles);
  CHECK(report.inverted == 0);
  CHECK(report[Metric::shape].min == Approx(flat[Metric::shape].min));
  CHECK(report[Metric::area].mean == Approx(flat[Metric::area].mean));
  CHECK(report.worst.front().element == flat.worst.front().element);
  auto bent = mesh_of<FullMesh>(sample);
  bent.point(OpenMesh::VertexHandle(50))[2] += 0.5;
  CHECK_THROWS_AS(trismooth::quality(bent), trismooth::MeshError);
}

TEST_CASE("of deleted faces quality knows nothing, and names the others by their own numbers") {
  const Sample sample = shuffled_grid(12, 37);
  auto mesh = mesh_of<FullMesh>(sample);
  const QualityReport whole = trismooth::quality(mesh);
  const auto worst = static_cast<int>(whole.worst[0].element);
  mesh.delete_face(OpenMesh::FaceHandle(0), true);
  mesh.delete_face(OpenMesh::FaceHandle(worst), true);
  mesh.delete_vertex(OpenMesh::VertexHandle(0), true);
  mesh.point(OpenMesh::VertexHandle(0)) = OpenMesh::Vec3d(std::nan(""));
  const QualityReport report = trismooth::quality(mesh);
  CHECK(report.triangles == std::distance(mesh.faces_sbegin(), mesh.faces_end()));
  CHECK(report.triangles < whole.triangles - 2);
  std::size_t at = 0;
  for (const trismooth::WorstElement& element : whole.worst) {
    if (!mesh.status(OpenMesh::FaceHandle(static_cast<int>(element.element))).deleted()) {
      CHECK(report.worst[at].element == element.element);
      CHECK(report.worst[at].shape == element.shape);
      ++at;
    }
  }
  CHECK(at > 3);
}

}  // namespace own_meshes

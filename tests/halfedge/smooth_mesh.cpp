// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/planar_samples.h"

namespace trismooth::smooth_mesh_test {

using planar_samples::Sample;

using Points = std::vector<Eigen::Vector3d>;

/// The sample through add_face, its points mapped to space by `place`.
template <class Place>
TriangleMesh mesh_of(const Sample& sample, const Place& place) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < sample.xyz.size(); i += 3) {
    mesh.add_vertex(place(Eigen::Vector3d(sample.xyz[i], sample.xyz[i + 1], sample.xyz[i + 2])));
  }
  for (const auto& [a, b, c] : sample.triangles) {
    REQUIRE(mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c)).is_valid());
  }
  return mesh;
}

TriangleMesh mesh_of(const Sample& sample) {
  return mesh_of(sample, [](const Eigen::Vector3d& p) { return p; });
}

Points points_of(const TriangleMesh& mesh) {
  Points points;
  for (const auto v : mesh.all_vertices()) {
    points.push_back(mesh.point(v));
  }
  return points;
}

/// Shape in space: the sign that of the triangle's normal along `normal`.
double shape_in_space(const Points& points, const Triangle& t, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d ab = points[t[1]] - points[t[0]];
  const Eigen::Vector3d ac = points[t[2]] - points[t[0]];
  return 2 * std::numbers::sqrt3 * ab.cross(ac).dot(normal) /
         (ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm());
}

double worst_shape(const Points& points, const std::vector<Triangle>& triangles, const Eigen::Vector3d& normal) {
  double worst = 1;
  for (const Triangle& t : triangles) {
    worst = std::min(worst, shape_in_space(points, t, normal));
  }
  return worst;
}

/// The sample's triangles, all in the orientation in which they are evaluated.
std::vector<Triangle> consistent(const Sample& sample) {
  trismooth::Workers workers(1);
  std::vector<trismooth::Point2<double>> points;
  for (std::size_t i = 0; i < sample.xyz.size(); i += 3) {
    points.push_back({sample.xyz[i], sample.xyz[i + 1]});
  }
  const auto topology = trismooth::connect_triangles(sample.vertex_count(), sample.triangles, workers);
  const auto reversed = trismooth::orient(topology, sample.triangles, points).reversed;
  std::vector<Triangle> triangles = sample.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (reversed[t] != 0) {
      std::swap(triangles[t][1], triangles[t][2]);
    }
  }
  return triangles;
}

Eigen::Matrix3d random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond rotation(normal(random), normal(random), normal(random), normal(random));
  return rotation.normalized().toRotationMatrix();
}

TEST_CASE("constraints hold in a halfedge mesh as they do in flat arrays") {
  std::mt19937_64 random(31);
  const Sample sample = planar_samples::shuffled(planar_samples::grid(14, 0.4, random), random);
  std::vector<std::uint8_t> fixed(sample.xyz.size() / 3, 0);
  std::ranges::generate(fixed, [&] { return random() % 10 == 0 ? std::uint8_t{1} : std::uint8_t{0}; });
  const std::vector<std::int32_t> ids{3, 50, 3};
  std::vector<std::int32_t> regions;
  for (const Triangle& t : sample.triangles) {
    regions.push_back(sample.xyz[3 * t[0]] + sample.xyz[3 * t[1]] + sample.xyz[3 * t[2]] < 21 ? 7 : -1);
  }
  const trismooth::Constraints constraints{.fixed = fixed, .fixed_ids = ids, .other_cells = {}, .regions = regions};

  std::vector<double> xy = sample.xy();
  const SmoothingResult expected = trismooth::smooth(trismooth::xy_points(xy), sample.triangles, constraints);
  TriangleMesh mesh = mesh_of(sample);
  const SmoothingResult result = trismooth::smooth(mesh, {.fixed = fixed, .fixed_ids = ids, .regions = regions}, {});
  CHECK(result.free_vertices == expected.free_vertices);
  CHECK(result.free_vertices < 13 * 13);
  CHECK(result.moved_vertices > 0);
  for (const auto v : mesh.all_vertices()) {
    const auto i = static_cast<std::size_t>(v.idx());
    CHECK(mesh.point(v).x() == xy[2 * i]);
    CHECK(mesh.point(v).y() == xy[2 * i + 1]);
    if (fixed[i] != 0 || v.idx() == 3 || v.idx() == 50) {
      CHECK(mesh.point(v) == Eigen::Vector3d(sample.xyz[3 * i], sample.xyz[3 * i + 1], sample.xyz[3 * i + 2]));
    }
  }
}

TEST_CASE("a backend that can analyses a halfedge mesh, tilted or not, and the bits are the same") {
  std::mt19937_64 random(40);
  const bool is_tilted = GENERATE(false, true);
  const Sample sample = planar_samples::shuffled(planar_samples::grid(14, 0.4, random), random);
  const Eigen::Matrix3d rotation = is_tilted ? random_rotation(random) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  TriangleMesh mesh = mesh_of(sample, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return rotation * p; });
  TriangleMesh by_host = mesh;
  const fakes::FakeBackend device;
  SmoothingOptions options;
  options.backend = &device;
  options.topology = trismooth::Topology::host;
  trismooth::smooth(by_host, options);
  CHECK(device.rings_found == 0);
  options.topology = trismooth::Topology::automatic;
  const SmoothingResult result = trismooth::smooth(mesh, options);
  CHECK(device.rings_found == (is_tilted ? 1 : 0));  // else it keeps the mesh, rings and all
  CHECK(device.prepared == 2);
  CHECK(result.backend == "cuda");
  CHECK(points_of(mesh) == points_of(by_host));
}

TEST_CASE("in a tilted plane vertices stay in the plane, boundaries where they are, and nothing gets worse") {
  std::mt19937_64 random(32);
  const Form form = GENERATE(Form::swap, Form::in_place);
  const double size = GENERATE(1.0, 1e-9, 1e150);
  SmoothingOptions options;
  options.form = form;
  for (const Sample& sample : planar_samples::manifold_samples()) {
    CAPTURE(sample.name, size);
    const Eigen::Matrix3d rotation = random_rotation(random);
    const Eigen::Vector3d offset = rotation * Eigen::Vector3d(3, 5, -20);
    TriangleMesh mesh =
        mesh_of(sample, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return size * (rotation * p + offset); });
    const Points before = points_of(mesh);
    const SmoothingResult result = trismooth::smooth(mesh, options);
    const Points after = points_of(mesh);

    const auto in_units = [&](Points points) {
      for (Eigen::Vector3d& p : points) {
        p /= size;
      }
      return points;
    };
    const Points old_points = in_units(before);
    const Points new_points = in_units(after);
    const Eigen::Vector3d normal = rotation.col(2);
    std::int64_t moved = 0;
    for (const auto v : mesh.all_vertices()) {
      const auto i = static_cast<std::size_t>(v.idx());
      moved += after[i] != before[i] ? 1 : 0;
      CHECK(std::abs(normal.dot(new_points[i] - old_points[i])) < 1e-12);
      if (mesh.is_boundary(v)) {
        CHECK(after[i] == before[i]);
      }
    }
    CHECK(moved == result.moved_vertices);
    CHECK((moved > 0) == (result.free_vertices > 0));
    const std::vector<Triangle> triangles = consistent(sample);
    CHECK(worst_shape(new_points, triangles, normal) >= worst_shape(old_points, triangles, normal) - 1e-13);
  }
}

TEST_CASE("a tangled halfedge mesh is untangled, tilted or not, and turned over where its inside is mirrored") {
  std::mt19937_64 random(34);
  const Sample sample = planar_samples::grid(14, 0.2, random);
  const bool is_tilted = GENERATE(false, true);
  const bool is_mirrored = GENERATE(false, true);
  const Eigen::Matrix3d rotation = is_tilted ? random_rotation(random) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  TriangleMesh mesh = mesh_of(sample, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return rotation * p; });
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto v : mesh.all_vertices()) {
    centre += mesh.point(v) / static_cast<double>(mesh.n_vertices());
  }
  const Eigen::Vector3d along = rotation.col(0);
  for (const auto v : mesh.all_vertices()) {
    if (!mesh.is_boundary(v)) {
      const Eigen::Vector3d p = mesh.point(v);
      mesh.set_point(v, is_mirrored ? Eigen::Vector3d(p - 2 * (p - centre).dot(along) * along) : centre);
    }
  }
  SmoothingOptions options;
  options.max_sweeps = 1;
  TriangleMesh as_it_is = mesh;
  const SmoothingResult unmended = trismooth::smooth(as_it_is, options);
  CHECK(unmended.inverted + unmended.degenerate > 0);
  options = {};
  options.untangle = trismooth::Untangle::on;
  const SmoothingResult result = trismooth::smooth(mesh, options);
  REQUIRE(result.untangling);
  CHECK(result.inverted == 0);
  CHECK(result.degenerate == 0);
  CHECK(result.untangling->inverted_before > 0);
  CHECK(result.untangling->inverted_after == 0);
  CHECK(result.untangling->turned_components == (is_mirrored ? 1 : 0));
  // The grid is listed one way round, and its sides have not moved.
  double least = 1;
  double most = -1;
  for (const Triangle& t : consistent(sample)) {
    const double shape = shape_in_space(points_of(mesh), t, rotation.col(2));
    least = std::min(least, shape);
    most = std::max(most, shape);
  }
  CHECK(least * most > 0);
}

TEST_CASE("a tilted mesh is smoothed like the flat one, to rounding") {
  std::mt19937_64 random(33);
  const Sample sample = planar_samples::grid(12, 0.3, random);
  SmoothingOptions options;
  options.method = trismooth::Method::laplacian;
  options.max_sweeps = 20;
  TriangleMesh flat = mesh_of(sample);
  trismooth::smooth(flat, options);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    TriangleMesh tilted = mesh_of(sample, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return rotation * p; });
    trismooth::smooth(tilted, options);
    for (const auto v : flat.all_vertices()) {
      CHECK((rotation * flat.point(v) - tilted.point(v)).norm() < 1e-12);
    }
  }
}

TEST_CASE("vertices without faces, however far, change no bit of a halfedge mesh and keep theirs") {
  std::mt19937_64 random(41);
  const bool tilted = GENERATE(false, true);
  const double far = GENERATE(1e7, 1e162, 1.7e308);
  const Sample sample = planar_samples::grid(12, 0.4, random);
  const Eigen::Matrix3d rotation = tilted ? random_rotation(random) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const auto place = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return rotation * p; };
  TriangleMesh alone = mesh_of(sample, place);
  TriangleMesh together = mesh_of(sample, place);
  const Eigen::Vector3d first(far, far, 0.3 * far);
  const Eigen::Vector3d second(-far, 1, far);
  together.add_vertex(first);
  together.add_vertex(second);
  const SmoothingResult expected = trismooth::smooth(alone);
  const SmoothingResult result = trismooth::smooth(together);
  CHECK(result.moved_vertices > 0);
  CHECK(result.sweeps == expected.sweeps);
  Points points = points_of(alone);
  points.insert(points.end(), {first, second});
  CHECK(points_of(together) == points);
}

TEST_CASE("a mesh whose faces run clockwise is smoothed to the same bits") {
  const Form form = GENERATE(Form::swap, Form::in_place);
  SmoothingOptions options;
  options.form = form;
  for (Sample sample : planar_samples::manifold_samples()) {
    CAPTURE(sample.name);
    TriangleMesh mesh = mesh_of(sample);
    planar_samples::list_clockwise(sample);
    TriangleMesh clockwise = mesh_of(sample);
    const SmoothingResult expected = trismooth::smooth(mesh, options);
    const SmoothingResult result = trismooth::smooth(clockwise, options);
    CHECK(result.sweeps == expected.sweeps);
    CHECK(points_of(clockwise) == points_of(mesh));
  }
}

TEST_CASE("connectivity and what the caller attached to the mesh are left alone") {
  std::mt19937_64 random(34);
  const Sample sample = planar_samples::grid(8, 0.4, random);
  TriangleMesh mesh = mesh_of(sample);
  mesh.request_vertex_status();
  mesh.status(mesh.vertex_handle(20)).set_selected(true);
  const std::vector<Triangle> triangles = trismooth::face_list(mesh);
  trismooth::smooth(mesh);
  CHECK(trismooth::face_list(mesh) == triangles);
  CHECK(mesh.status(mesh.vertex_handle(20)).selected());
}

TEST_CASE("points that are not finite or lie in no plane are refused, the mesh is left as it was") {
  std::mt19937_64 random(36);
  const Sample sample = planar_samples::grid(6, 0.3, random);
  const double bad = GENERATE(1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());
  TriangleMesh mesh = mesh_of(sample);
  const auto v = mesh.vertex_handle(24);
  mesh.point(v).z() = bad;
  const Points before = points_of(mesh);
  CHECK_THROWS_AS(trismooth::smooth(mesh), trismooth::MeshError);
  mesh.point(v).z() = 0.25;
  Points restored = before;
  restored[24].z() = 0.25;
  CHECK(points_of(mesh) == restored);
}

TEST_CASE("points that no double can place in their tilted plane are refused") {
  std::mt19937_64 random(37);
  const auto far_apart = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(5e307 * (p.x() - 3), 5e307 * (p.y() - 3), 5e307 * (p.x() - 3));
  };
  TriangleMesh mesh = mesh_of(planar_samples::grid(6, 0.3, random), far_apart);
  CHECK_THROWS_AS(trismooth::smooth(mesh), trismooth::MeshError);
}

TEST_CASE("options and constraints that do not fit are refused") {
  std::mt19937_64 random(37);
  TriangleMesh mesh = mesh_of(planar_samples::grid(4, 0.3, random));
  SmoothingOptions options;
  options.max_sweeps = -1;
  CHECK_THROWS_AS(trismooth::smooth(mesh, options), std::invalid_argument);
  const std::vector<std::uint8_t> flags(24, 0);
  CHECK_THROWS_AS(trismooth::smooth(mesh, {.fixed = flags}), std::invalid_argument);
  const std::vector<std::int32_t> ids{25};
  CHECK_THROWS_AS(trismooth::smooth(mesh, {.fixed_ids = ids}), std::invalid_argument);
  const std::vector<std::int32_t> regions(31, 0);
  CHECK_THROWS_AS(trismooth::smooth(mesh, {.regions = regions}), std::invalid_argument);
}

TEST_CASE("an empty mesh and points without faces have nothing to smooth") {
  TriangleMesh mesh;
  CHECK(trismooth::smooth(mesh).moved_vertices == 0);
  mesh.add_vertex({1, 2, 3});
  mesh.add_vertex({1, 2, 4});
  CHECK(trismooth::smooth(mesh).moved_vertices == 0);
  CHECK(mesh.point(mesh.vertex_handle(1)) == Eigen::Vector3d(1, 2, 4));
}

TEST_CASE("stopping from the progress callback leaves a valid mesh") {
  std::mt19937_64 random(38);
  const Sample sample = planar_samples::grid(12, 0.45, random);
  TriangleMesh mesh = mesh_of(sample);
  const Points before = points_of(mesh);
  const std::vector<Triangle> triangles = trismooth::face_list(mesh);
  SmoothingOptions options;
  options.form = Form::swap;
  options.progress = [](const trismooth::SweepRecord& sweep) {
    return sweep.sweep == 2 ? trismooth::Progress::stop : trismooth::Progress::proceed;
  };
  const SmoothingResult result = trismooth::smooth(mesh, options);
  CHECK(result.stop_reason == trismooth::StopReason::cancelled);
  CHECK(result.sweeps == 2);
  CHECK(worst_shape(points_of(mesh), triangles, Eigen::Vector3d::UnitZ()) >=
        worst_shape(before, triangles, Eigen::Vector3d::UnitZ()));
}

}  // namespace trismooth::smooth_mesh_test

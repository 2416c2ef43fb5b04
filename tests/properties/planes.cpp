// SPDX-License-Identifier: BSD-3-Clause
// What holds of meshes in planes of space that are known exactly, from inclined by a thousandth of a millionth on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/space/plane_smoothing.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "properties/with_unused.h"
#include "support/used_frame.h"

using namespace properties;
using Eigen::Vector3d;
using trismooth::MeshDocument;

namespace {

/// The plane in which a mesh is put: its coordinates along two orthonormal vectors.
struct Place {
  Eigen::Matrix3d rotation;
  double size;

  Vector3d operator()(test_meshes::Point p) const { return size * (rotation * Vector3d(p.x, p.y, 0)); }
  Vector3d normal() const { return rotation.col(2); }
};

Place random_place(test_meshes::Random& random) {
  const double direction = random.between(0, 6.3);
  const double inclination = std::pow(10.0, random.between(-9, 0));
  Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(inclination, Vector3d(std::cos(direction), std::sin(direction), 0)).toRotationMatrix();
  if (const std::int32_t axis = random.below(3); axis < 2) {
    rotation.row(axis).swap(rotation.row(2));
  }
  return {rotation, std::ldexp(1.0, random.below(60) - 30)};
}

/// The mesh in its frame: of an extent near 1.
RandomMesh in_frame(RandomMesh mesh) {
  const auto frame = test_meshes::used_frame(mesh.mesh.points, mesh.mesh.triangles, mesh.other_cells);
  for (auto& p : mesh.mesh.points) {
    p = frame.enter(p);
  }
  return mesh;
}

MeshDocument document_of(const RandomMesh& mesh, const std::vector<Vector3d>& points) {
  MeshDocument document;
  for (const Vector3d& p : points) {
    document.points.insert(document.points.end(), {p.x(), p.y(), p.z()});
  }
  for (const trismooth::Triangle& t : mesh.mesh.triangles) {
    document.cells.append(trismooth::cell_type::triangle, t);
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.other_cells.size()); ++v) {
    if (mesh.other_cells[v] != 0) {
      document.cells.append(trismooth::cell_type::vertex, std::vector{v});
    }
  }
  return document;
}

struct Smoothed {
  SmoothingResult result;
  bool aligned = false;
};

/// Smooths the document's points in place, as a run over a file does.
Smoothed smooth(MeshDocument& document, const RandomMesh& mesh, const SmoothingOptions& options) {
  trismooth::PlanarMesh planar = trismooth::planar_mesh(document, "mesh");
  trismooth::LocalPoints local;
  const auto enter_frame = [&] {
    local = trismooth::entered(
        test_meshes::used_frame(planar.points, planar.elements.triangles(), planar.in_other_cell), planar.points);
  };
  enter_frame();
  trismooth::Workers workers(1);
  auto found = trismooth::find_mesh_rings(
      local.points, planar.elements.triangles(),
      {.fixed = mesh.fixed, .fixed_ids = mesh.fixed_ids, .other_cells = planar.in_other_cell, .regions = mesh.regions},
      workers);
  if (trismooth::settle_plane(planar, document, found.fixed, "mesh", workers)) {
    enter_frame();
  }
  return {trismooth::smooth_in_plane(found, planar.elements.triangles(), planar.plane, document.points, planar.points,
                                     local, Storage::float64, options),
          planar.plane.aligned};
}

/// The largest distance between two of the points along an axis, of those for which `counts(number)`.
template <class Counts>
double extent_of(const std::vector<test_meshes::Point>& points, const Counts& counts) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (counts(v)) {
      x.push_back(points[v].x);
      y.push_back(points[v].y);
    }
  }
  const auto range = [](const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::ranges::max_element(values) - *std::ranges::min_element(values);
  };
  return std::max(range(x), range(y));
}

/// Whether there are triangles, and what stays has an extent of which rounding elsewhere is not a millionth.
bool suits(const RandomMesh& mesh) {
  const std::vector<bool> fixed = connectivity_of(mesh).fixed;
  return !mesh.mesh.triangles.empty() && extent_of(mesh.mesh.points, [&](std::size_t v) { return fixed[v]; }) > 1e-6;
}

std::vector<Vector3d> placed(const RandomMesh& mesh, const Place& place) {
  std::vector<Vector3d> points;
  std::ranges::transform(mesh.mesh.points, std::back_inserter(points), place);
  return points;
}

}  // namespace

TEST_CASE("what moves of a mesh in a plane lies in the plane, to rounding, however little that is inclined") {
  std::int64_t moved = 0;
  for_random_meshes(1000, [&](const RandomMesh& any) -> std::string {
    const RandomMesh mesh = in_frame(any);
    if (!suits(mesh)) {
      return {};
    }
    return for_some_options(mesh, 2, [&](const SmoothingOptions& options, test_meshes::Random& random) -> std::string {
      const Place place = random_place(random);
      MeshDocument document = document_of(mesh, placed(mesh, place));
      const std::vector<double> before = document.points;
      moved += smooth(document, mesh, options).result.moved_vertices;
      for (std::size_t v = 0; v < mesh.mesh.points.size(); ++v) {
        const Eigen::Map<const Vector3d> point(document.points.data() + 3 * v);
        const double distance = std::abs(place.normal().dot(point)) / place.size;
        if (point != Eigen::Map<const Vector3d>(before.data() + 3 * v) && !(distance < 1e-12)) {
          return fmt::format("vertex {} is {} off the plane", v, distance);
        }
      }
      return {};
    });
  });
  CHECK(moved >= meshes_of(1000));
}

TEST_CASE("in a plane of space, unused vertices at the end change no bit, wherever they are") {
  for_random_meshes(500, [](const RandomMesh& any) -> std::string {
    const RandomMesh mesh = in_frame(any);
    if (!suits(mesh)) {
      return {};
    }
    return for_some_options(mesh, 2, [&](const SmoothingOptions& options, test_meshes::Random& random) -> std::string {
      Place place = random_place(random);
      if (random.below(3) == 0) {
        place.rotation.setIdentity();
      }
      const WithUnused more = with_unused_vertices(mesh, true, random);
      std::vector<Vector3d> points = placed(mesh, place);
      MeshDocument alone = document_of(mesh, points);
      for (std::size_t v = points.size(); v < more.mesh.mesh.points.size(); ++v) {
        const auto [x, y] = more.mesh.mesh.points[v];
        points.emplace_back(x, y, random.below(2) == 0 ? x : 0.5 * y);
      }
      MeshDocument together = document_of(more.mesh, points);
      std::vector<double> expected = together.points;
      const Smoothed of_alone = smooth(alone, mesh, options);
      const Smoothed of_together = smooth(together, more.mesh, options);
      if (of_alone.aligned != of_together.aligned ||
          of_alone.result.moved_vertices != of_together.result.moved_vertices) {
        return "another plane";
      }
      std::ranges::copy(alone.points, expected.begin());
      return difference(together.points, expected);
    });
  });
}

// SPDX-License-Identifier: BSD-3-Clause
// Halfedge meshes and planes of space give the bits of the flat arrays.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/quality/orientation.h"

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

namespace {

/// Whether all points have one x or one y, up to what subnormal numbers can halve.
bool is_along_an_axis(const std::vector<Point2<double>>& points) {
  return std::ranges::all_of(points, [&](Point2<double> p) { return p.x / 2 == points[0].x / 2; }) ||
         std::ranges::all_of(points, [&](Point2<double> p) { return p.y / 2 == points[0].y / 2; });
}

/// Smooths the mesh as one of space, in the plane of two coordinate axes; nothing where a halfedge mesh cannot hold it.
std::optional<Run> run_in_space(const RandomMesh& mesh, const SmoothingOptions& options, std::array<int, 2> axes,
                                double across) {
  trismooth::Workers workers(1);
  auto topology = trismooth::connect_triangles(mesh.mesh.vertex_count(), mesh.mesh.triangles, workers);
  const trismooth::LocalFrame frame = trismooth::local_frame(mesh.mesh.points);
  std::vector<Point2<double>> local;
  std::vector<double> xyz;
  for (const Point2<double> p : mesh.mesh.points) {
    local.push_back(frame.enter(p));
    std::array point{across, across, across};
    point[static_cast<std::size_t>(axes[0])] = p.x;
    point[static_cast<std::size_t>(axes[1])] = p.y;
    xyz.insert(xyz.end(), point.begin(), point.end());
  }
  const auto orientation = trismooth::orient(topology, mesh.mesh.triangles, local);
  auto halfedges = trismooth::build_halfedge_mesh(xyz, mesh.mesh.triangles, topology, orientation.reversed, workers);
  if (!halfedges.copies_of.empty()) {
    return std::nullopt;
  }
  Run run;
  run.result = trismooth::smooth(halfedges.mesh,
                                 {.fixed = mesh.fixed,
                                  .fixed_ids = mesh.fixed_ids,
                                  .other_cells = mesh.other_cells,
                                  .regions = mesh.regions,
                                  .slide = mesh.slide},
                                 options);
  for (std::size_t v = 0; v < mesh.mesh.points.size(); ++v) {
    const Eigen::Vector3d point = halfedges.mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)));
    run.xy.insert(run.xy.end(), {point[axes[0]], point[axes[1]]});
    const int third = 3 - axes[0] - axes[1];
    if (!same_bits(point[third], across)) {
      run.xy.back() = point[third] / 0.0;  // out of its plane
    }
  }
  return run;
}

}  // namespace

TEST_CASE("a halfedge mesh, in whichever plane of two coordinate axes, is smoothed as flat arrays are") {
  std::int64_t held = 0;
  std::int64_t looked_at = 0;
  for_random_meshes(3000, [&](const RandomMesh& mesh) {
    ++looked_at;
    const bool is_line = is_along_an_axis(mesh.mesh.points);
    if (is_line && !keeps_digits(mesh.mesh.xy())) {
      return std::string{};  // what was halved away is in some plane and not in another
    }
    return for_some_options(mesh, 1, [&](const SmoothingOptions& options, test_meshes::Random& random) -> std::string {
      const Run expected = run(mesh, options);
      const double across = random.below(2) == 0 ? 0 : 4e7;
      for (const std::array<int, 2> axes : {std::array{0, 1}, {0, 2}, {1, 2}}) {
        const std::optional<Run> found = run_in_space(mesh, options, axes, across);
        if (!found) {
          return {};
        }
        // A line lies in any plane along it: which of two zeros a vertex then keeps depends on the plane.
        const std::string wrong = is_line ? difference_in_value(*found, expected) : difference(*found, expected);
        if (!wrong.empty()) {
          return fmt::format("axes {} and {}, {} across: {}", axes[0], axes[1], across, wrong);
        }
      }
      ++held;
      return {};
    });
  });
  CHECK(2 * held > looked_at);
}

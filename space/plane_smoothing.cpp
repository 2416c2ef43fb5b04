// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/plane_smoothing.h"

#include <cstddef>
#include <cstdint>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/backend_choice.h"

namespace trismooth {

namespace {

/// Vertices that a thread takes at a time.
constexpr std::int64_t space_grain = 8192;

}  // namespace

StoredImage image_of(const Plane& plane, Storage storage) {
  using Numbers = Eigen::Map<const Eigen::Vector3d>;
  return {3, [&plane](std::size_t /*vertex*/, const double* stored) { return plane.project(Numbers(stored)); },
          [&plane](const double* stored, Point2<double> from, Point2<double> to, double* moved) {
            Eigen::Map<Eigen::Vector3d>{moved} = plane.moved(Numbers(stored), from, to);
          },
          [storage](double number) { return rounded_to(storage, number); }};
}

SmoothingResult smooth_in_image(MeshRings& mesh, const ElementList& elements,
                                std::span<const QuadraticElement> quadratics, std::span<const MiddleNode> middles,
                                const StoredImage& image, std::span<double> xyz, BulkVector<Point2<double>>& points,
                                const LocalPoints& local, Storage swept, const SmoothingOptions& options) {
  SmoothingOptions in_image = options;
  // What has been untangled needs the guard that knows what the sweeps began with, too.
  in_image.guard = options.guard && options.untangles();
  // The commit asks for the rings once more.
  const auto smoother = backend_of(options).prepare(mesh, elements, local.points, in_image);
  BulkVector<Point2<double>> moved = points;
  SmoothingResult result = smoother->smooth(moved, swept, local.frame);
  Workers workers(options.threads);
  commit({mesh, elements, quadratics, middles, local, moved}, image, xyz, points, options, workers, result);
  mesh.rings = {};
  return result;
}

SmoothingResult smooth_in_plane(MeshRings& mesh, const ElementList& elements, const Plane& plane, std::span<double> xyz,
                                BulkVector<Point2<double>>& points, const LocalPoints& local, Storage storage,
                                const SmoothingOptions& options) {
  if (!plane.aligned) {
    return smooth_in_image(mesh, elements, {}, {}, image_of(plane, storage), xyz, points, local, Storage::float64,
                           options);
  }
  const auto smoother = backend_of(options).prepare(with_rings_of(mesh), elements, local.points, options);
  SmoothingResult result = smoother->smooth(points, storage, local.frame);
  Workers(options.threads).for_blocks(std::ssize(points), space_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      Eigen::Map<Eigen::Vector3d> point(xyz.data() + 3 * v);
      if (const Point2<double> before = plane.project(point); !(before == points[v])) {
        point = rounded_to(storage, plane.moved(point, before, points[v]));
      }
    }
  });
  return result;
}

}  // namespace trismooth

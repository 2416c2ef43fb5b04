#include "trismooth/cuda/host_untangling.h"

#include <utility>

#include "trismooth/base/local_points.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/cpu_backend.h"

namespace trismooth::cuda {

namespace {

SmoothingOptions on_host(SmoothingOptions options) {
  options.execution = Execution::resident;
  options.layout = Layout::aos;
  options.order = Order::colour;
  return options;
}

}  // namespace

HostUntangling::HostUntangling(MeshRings mesh, std::span<const Triangle> triangles, const SmoothingOptions& options)
    : mesh_(std::move(mesh)), triangles_(triangles.begin(), triangles.end()), options_(on_host(options)) {}

SmoothingResult HostUntangling::smooth(std::span<Point2<double>> points, Storage storage) {
  if (smoother_ == nullptr) {
    const std::vector<Point2<double>> input(points.begin(), points.end());
    const LocalPoints local = entered(local_frame_of_cells(input, mesh_.fixed), input);
    smoother_ = cpu_backend().prepare(mesh_, triangles_, local.points, options_);
  }
  SmoothingResult result = smoother_->smooth(points, storage, std::nullopt);
  result.backend_note = "the mesh has inverted triangles, which the CPU untangles";
  return result;
}

SmoothingResult untangle_on_host(std::vector<std::uint8_t> fixed, std::span<const Triangle> triangles,
                                 const SmoothingOptions& options, std::span<Point2<double>> points, Storage storage) {
  Workers workers(options.threads);
  const std::vector<Point2<double>> input(points.begin(), points.end());
  const LocalPoints local = entered(local_frame_of_cells(input, fixed), input);
  const TriangleTopology topology = connect_triangles(static_cast<std::int32_t>(points.size()), triangles, workers);
  MeshRings mesh;
  mesh.fixed = std::move(fixed);
  mesh.reversed = orient(topology, triangles, local.points).reversed;
  mesh.rings = one_rings(topology, triangles, mesh.reversed, mesh.fixed, workers);
  return HostUntangling(std::move(mesh), triangles, options).smooth(points, storage);
}

}  // namespace trismooth::cuda

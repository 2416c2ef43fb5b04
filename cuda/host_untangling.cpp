#include "trismooth/cuda/host_untangling.h"

#include <utility>

#include "trismooth/base/local_points.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth::cuda {

namespace {

SmoothingOptions on_host(SmoothingOptions options) {
  options.execution = Execution::resident;
  options.layout = Layout::aos;
  options.order = Order::colour;
  return options;
}

}  // namespace

HostUntangling::HostUntangling(std::vector<std::uint8_t> fixed, std::span<const Triangle> triangles,
                               const SmoothingOptions& options)
    : fixed_(std::move(fixed)), triangles_(triangles.begin(), triangles.end()), options_(on_host(options)) {}

SmoothingResult HostUntangling::smooth(std::span<Point2<double>> points, Storage storage) {
  const LocalFrame frame = local_frame_of_cells(points, fixed_);
  if (smoother_ == nullptr) {
    const LocalPoints local = entered(frame, points);
    Workers workers(options_.threads);
    Constraints constraints;
    constraints.fixed = fixed_;
    MeshRings mesh = find_mesh_rings(local.points, triangles_, constraints, workers);
    mesh.fixed = fixed_;  // with the reasons
    smoother_ = cpu_backend().prepare(mesh, triangles_, local.points, options_);
  }
  SmoothingResult result = smoother_->smooth(points, storage, frame);
  result.backend_note = "the mesh has inverted triangles, which the CPU untangles";
  return result;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/host_untangling.h"

#include <cstddef>
#include <utility>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/invalid_triangles.h"
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
                               const SmoothingOptions& options, Slidable slidable)
    : fixed_(std::move(fixed)),
      triangles_(triangles.begin(), triangles.end()),
      options_(on_host(options)),
      slidable_(std::move(slidable)) {}

void HostUntangling::aim_at(std::span<const Point2<double>> reference, const LocalFrame& frame) {
  reference_.assign(reference.begin(), reference.end());
  frame_of_reference_ = frame;
}

SmoothingResult HostUntangling::smooth(std::span<Point2<double>> points, Storage storage, const LocalFrame& frame) {
  Workers workers(options_.threads);
  if (smoother_ == nullptr) {
    const LocalPoints local = reference_.empty() ? entered(frame, points) : entered(frame_of_reference_, reference_);
    Constraints constraints;
    constraints.fixed = fixed_;
    MeshRings mesh = find_mesh_rings(local.points, triangles_, constraints, workers);
    mesh.fixed = fixed_;  // with the reasons
    mesh.slidable = slidable_;
    reversed_ = mesh.reversed;
    smoother_ = cpu_backend().prepare(mesh, triangles_, local.points, options_);
    if (!reference_.empty()) {
      smoother_->aim_at(reference_, frame_of_reference_);
      reference_ = {};
    }
  }
  SmoothingResult result = smoother_->smooth(points, storage, frame);
  count_invalid(
      triangles_, reversed_, [&](std::int32_t v) { return frame.enter(points[v]); }, workers, result);
  result.backend_note = "the mesh has inverted triangles, which the CPU untangles";
  return result;
}

UntanglingResult HostUntangling::not_tangled(std::span<const std::uint8_t> reversed,
                                             std::span<const Point2<double>> points, const LocalFrame& frame) const {
  UntanglingResult result;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle corners = canonical_corners(triangles_[t], reversed[t] != 0);
    if (!(shape_quotient(points_of(corners, [&](std::int32_t v) { return frame.enter(points[v]); })) > 0)) {
      ++(all_are_fixed(corners, fixed_) ? result.inverted_fixed : result.inverted_after);
    }
  }
  return result;
}

}  // namespace trismooth::cuda

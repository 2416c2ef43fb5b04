// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/host_untangling.h"

#include <cstddef>
#include <string>
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

HostUntangling::HostUntangling(std::vector<std::uint8_t> fixed, const ElementList& elements,
                               const SmoothingOptions& options, Slidable slidable)
    : fixed_(std::move(fixed)), elements_(elements), options_(on_host(options)), slidable_(std::move(slidable)) {}

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
    MeshRings mesh = find_mesh_rings(local.points, elements_.list(), constraints, workers);
    mesh.fixed = fixed_;  // with the reasons
    mesh.slidable = slidable_;
    reversed_ = mesh.reversed;
    smoother_ = cpu_backend().prepare(std::move(mesh), elements_.list(), local.points, options_);
    if (!reference_.empty()) {
      smoother_->aim_at(reference_, frame_of_reference_);
      reference_ = {};
    }
  }
  SmoothingResult result = smoother_->smooth(points, storage, frame);
  elements_.list().visit([&](const auto& listed) {
    count_invalid(
        listed, reversed_, [&](std::int32_t v) { return frame.enter(points[v]); }, workers, result);
  });
  result.backend_note = std::string("the mesh has inverted ") +
                        (elements_.list().are_triangles() ? "triangles" : "elements") + ", which the CPU untangles";
  return result;
}

UntanglingResult HostUntangling::not_tangled(std::span<const std::uint8_t> reversed,
                                             std::span<const Point2<double>> points, const LocalFrame& frame) const {
  UntanglingResult result;
  elements_.list().visit([&](const auto& listed) {
    for (std::size_t e = 0; e < listed.size(); ++e) {
      const auto corners = canonical_corners(listed[e], reversed[e] != 0);
      if (!(quotient_at(corners, [&](std::int32_t v) { return frame.enter(points[v]); }) > 0)) {
        ++(all_are_fixed(corners, fixed_) ? result.inverted_fixed : result.inverted_after);
      }
    }
  });
  return result;
}

}  // namespace trismooth::cuda

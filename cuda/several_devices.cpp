// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/several_devices.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/host_untangling.h"
#include "trismooth/cuda/part_offloads.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/in_parts/parts_smoother.h"
#include "trismooth/smoothing/noted_smoother.h"

namespace trismooth::cuda {

namespace {

using Devices = std::vector<int>;

/// Parts that share NCCL's communicators: what two plans exchange must not meet.
std::mutex& turns() {
  static std::mutex mutex;
  return mutex;
}

class SharedSmoother final : public PreparedSmoother {
 public:
  SharedSmoother(MeshRings mesh, const ElementList& elements, std::span<const Point2<double>> local,
                 const SmoothingOptions& options, const Devices& devices) {
    if (options.untangles()) {
      untangling_.emplace(mesh.fixed, elements, options, mesh.slidable);
    }
    const std::lock_guard lock(turns());
    smoother_ = prepare_in_parts(
        std::move(mesh), elements, local, options, static_cast<int>(devices.size()),
        [&](const MeshPart& part) { return part_offloads_on(devices[static_cast<std::size_t>(part.number)]); });
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    const LocalFrame frame = known_frame ? *known_frame : local_frame_of_cells(points, smoother_->fixed());
    try {
      const std::lock_guard lock(turns());
      return smoother_->smooth(points, storage, frame);
    } catch (const PartsError&) {
      return untangling_.value().smooth(points, storage, frame);
    }
  }

  std::vector<std::uint8_t> fixed() const override { return smoother_->fixed(); }

 private:
  std::unique_ptr<PreparedSmoother> smoother_;
  std::optional<HostUntangling> untangling_;  ///< where the mesh may have to be untangled
};

class SeveralDevices final : public Backend {
 public:
  explicit SeveralDevices(Devices devices) : devices_(std::move(devices)) {}

  std::string name() const override { return backend().name(); }
  void require_ready() const override {
    for (const int device : devices_) {
      const DeviceScope scope(device);
      backend().require_ready();
    }
  }
  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    options.validate();
    if (options.order == Order::unordered || options.execution != Execution::resident) {
      throw std::invalid_argument("executions and orders of the paper's CUDA versions are for one device");
    }
    if (mesh.part != nullptr) {
      throw std::invalid_argument("a part of a mesh is smoothed on one device");
    }
    if (mesh.slidable.is_wanted()) {
      return std::make_unique<NotedSmoother>(
          backend_on(std::span(devices_).first(1))->prepare_kept(mesh, elements, local, options),
          "vertices slide on one device, not on several");
    }
    require_ready();
    return std::make_unique<SharedSmoother>(std::move(mesh), elements, local, options, devices_);
  }

  bool takes_quadrilaterals() const override { return true; }

 private:
  Devices devices_;
};

}  // namespace

std::unique_ptr<Backend> backend_on_several(std::span<const int> devices) {
  return std::make_unique<SeveralDevices>(Devices(devices.begin(), devices.end()));
}

}  // namespace trismooth::cuda

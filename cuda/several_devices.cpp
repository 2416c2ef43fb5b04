#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/host_untangling.h"
#include "trismooth/cuda/part_offloads.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/in_parts/parts_smoother.h"
#include "trismooth/smoothing/noted_smoother.h"

namespace trismooth::cuda {

namespace {

using Devices = std::vector<int>;

/// A smoother of one device, whichever is current.
class SmootherOnDevice final : public PreparedSmoother {
 public:
  SmootherOnDevice(int device, std::unique_ptr<PreparedSmoother> smoother)
      : device_(device), smoother_(std::move(smoother)) {}
  ~SmootherOnDevice() override { after_.begin(device_); }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& frame) override {
    const DeviceScope scope(device_);
    return smoother_->smooth(points, storage, frame);
  }
  std::vector<std::uint8_t> fixed() const override {
    const DeviceScope scope(device_);
    return smoother_->fixed();
  }

 private:
  DeviceAtEnd after_;  ///< the last to go
  int device_;
  std::unique_ptr<PreparedSmoother> smoother_;
};

/// backend() on one device, whichever is current.
class OneDevice final : public Backend {
 public:
  explicit OneDevice(int device) : device_(device) {}

  std::string name() const override { return backend().name(); }
  void require_ready() const override {
    const DeviceScope scope(device_);
    backend().require_ready();
  }
  void start(std::int64_t vertices) const override {
    const DeviceScope scope(device_);
    backend().start(vertices);
  }
  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, std::span<const Triangle> triangles,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    return prepare_kept(mesh, triangles, local, options);
  }
  std::unique_ptr<PreparedSmoother> prepare_kept(const MeshRings& mesh, std::span<const Triangle> triangles,
                                                 std::span<const Point2<double>> local,
                                                 const SmoothingOptions& options) const override {
    const DeviceScope scope(device_);
    if (mesh.part != nullptr && !mesh.part->is_whole) {
      return prepare_part(mesh, triangles, local, options, part_offloads_on(device_));
    }
    return on_device(backend().prepare_kept(mesh, triangles, local, options));
  }
  std::optional<MeshRings> find_rings(std::span<const Point2<double>> local, std::span<const Triangle> triangles,
                                      const Constraints& constraints, const SmoothingOptions& options) const override {
    const DeviceScope scope(device_);
    return backend().find_rings(local, triangles, constraints, options);
  }
  std::unique_ptr<PreparedSmoother> prepare_mesh(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                                 const Constraints& constraints,
                                                 const SmoothingOptions& options) const override {
    const DeviceScope scope(device_);
    return on_device(backend().prepare_mesh(vertex_count, triangles, constraints, options));
  }

 private:
  std::unique_ptr<PreparedSmoother> on_device(std::unique_ptr<PreparedSmoother> smoother) const {
    return smoother == nullptr ? nullptr : std::make_unique<SmootherOnDevice>(device_, std::move(smoother));
  }

  int device_;
};

/// Parts that share NCCL's communicators: what two plans exchange must not meet.
std::mutex& turns() {
  static std::mutex mutex;
  return mutex;
}

class SharedSmoother final : public PreparedSmoother {
 public:
  SharedSmoother(MeshRings mesh, std::span<const Triangle> triangles, std::span<const Point2<double>> local,
                 const SmoothingOptions& options, const Devices& devices) {
    if (options.untangles()) {
      untangling_.emplace(mesh.fixed, triangles, options, mesh.slidable);
    }
    const std::lock_guard lock(turns());
    smoother_ = prepare_in_parts(
        std::move(mesh), triangles, local, options, static_cast<int>(devices.size()),
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
      OneDevice(device).require_ready();
    }
  }
  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, std::span<const Triangle> triangles,
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
      return std::make_unique<NotedSmoother>(OneDevice(devices_.front()).prepare_kept(mesh, triangles, local, options),
                                             "vertices slide on one device, not on several");
    }
    require_ready();
    return std::make_unique<SharedSmoother>(std::move(mesh), triangles, local, options, devices_);
  }

 private:
  Devices devices_;
};

}  // namespace

std::unique_ptr<Backend> backend_on(std::span<const int> devices) {
  if (devices.empty()) {
    throw std::invalid_argument("no devices: name one at least");
  }
  if (std::ranges::min(devices) < 0) {
    throw std::invalid_argument("devices: " + std::to_string(std::ranges::min(devices)) + " is no number of a device");
  }
  require_device();
  const auto there = static_cast<int>(survey_devices().devices.size());
  if (const int last = std::ranges::max(devices); last >= there) {
    throw DeviceError("CUDA: there is no device " + std::to_string(last) + ": this machine has " +
                      std::to_string(there) + ", numbered from 0");
  }
  if (devices.size() == 1) {
    return std::make_unique<OneDevice>(devices.front());
  }
  return std::make_unique<SeveralDevices>(Devices(devices.begin(), devices.end()));
}

}  // namespace trismooth::cuda

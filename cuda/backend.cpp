// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/backend.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/overwriting.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/cuda/device_follower.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/device_smoother.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/host_untangling.h"
#include "trismooth/cuda/part_offloads.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/cuda/runtime/host_copy.h"
#include "trismooth/cuda/runtime/timeline.h"
#include "trismooth/cuda/several_devices.h"
#include "trismooth/cuda/slide/sliding_options.h"
#include "trismooth/cuda/topology/find_rings.h"
#include "trismooth/cuda/topology/uploaded_constraints.h"
#include "trismooth/cuda/uploaded_rings.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/follower.h"
#include "trismooth/smoothing/noted_smoother.h"
#include "trismooth/smoothing/rings/fixed_elements.h"

namespace trismooth::cuda {

namespace {

/// Smooths coordinates of the host: there and back, with the time that it takes. Where the way back breaks off, they
/// are what they were, which is kept in `kept`; null: some have been written.
template <class Smooth>
SmoothingResult smooth_host_points(const Context& context, HostCopier& copier, DeviceBuffer<Point2<double>>& stored,
                                   std::span<Point2<double>> points, ScratchBytes* kept, const Smooth& smooth) {
  // From here on keeping pays for a thread.
  constexpr std::size_t many_bytes = std::size_t{1} << 20U;
  Overwriting target(std::as_writable_bytes(points), kept, copier.workers());
  Timeline timeline(context);
  timeline.mark();
  copier.upload(stored, std::span<const Point2<double>>(points));
  timeline.mark();
  if (points.size_bytes() >= many_bytes) {
    target.keep_meanwhile();
  }
  SmoothingResult result = smooth();
  Timeline way_back(context);
  way_back.mark();
  if (result.moved_vertices > 0) {
    copier.download(target, stored);
  }
  way_back.mark();
  result.timings.transfer_in = timeline.milliseconds(0);
  result.timings.transfer_out = way_back.milliseconds(0);
  return result;
}

class RingSmoother final : public PreparedSmoother {
 public:
  RingSmoother(const MeshRings& mesh, const ElementList& elements, std::span<const Point2<double>> local,
               const SmoothingOptions& options)
      : copier_(context_, options.threads),
        stored_(context_, with_room_for(mesh.rings, options, local.size())),
        frame_(context_, 1),
        fixed_(mesh.fixed),
        is_guarded_(options.guard) {
    const Stopwatch watch;
    smoother_ = make_device_smoother(context_, uploaded(copier_, mesh.rings), copier_.uploaded(local), options);
    if (mesh.slidable.any()) {
      smoother_->slide_on(mesh.slidable, mesh.slidable.flags_of_elements(mesh.reversed));
    }
    is_to_slide_ = mesh.slidable.is_wanted();
    if (options.untangles()) {
      untangling_.emplace(mesh.fixed, elements, options, mesh.slidable);
      reversed_ = mesh.reversed;
    }
    if (options.measures_shape() || options.untangles()) {
      fixed_elements_ = FixedElements(elements, mesh.reversed, mesh.fixed, copier_.workers());
    }
    context_.synchronize();
    prepare_ms_ = watch.milliseconds();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    smoother_->read_sizes(fixed_);
    const LocalFrame frame = known_frame ? *known_frame : local_frame_of_cells(points, fixed_);
    const double fixed_quotient =
        fixed_elements_.smallest_quotient([&](std::int32_t v) { return frame.enter(points[v]); });
    frame_.upload({&frame, 1});
    bool is_tangled = false;
    SmoothingResult result = smooth_host_points(context_, copier_, stored_, points, nullptr, [&] {
      is_tangled = untangling_ && smoother_->is_tangled(stored_.data(), frame_.data());
      return is_tangled ? SmoothingResult{} : smoother_->smooth(stored_.data(), frame_.data(), storage, fixed_quotient);
    });
    if (is_tangled) {
      result = untangling_->smooth(points, storage, frame);
    } else if (untangling_) {
      result.untangling =
          fixed_quotient > 0 && is_guarded_ ? UntanglingResult{} : untangling_->not_tangled(reversed_, points, frame);
    }
    if (is_to_slide_ && !result.sliding) {
      result.sliding.emplace();
    }
    result.timings.prepare = std::exchange(prepare_ms_, 0);
    return result;
  }

  std::vector<std::uint8_t> fixed() const override { return fixed_; }

 private:
  static std::size_t with_room_for(const OneRings& rings, const SmoothingOptions& options, std::size_t vertices) {
    require_room_for(rings, options);
    return vertices;
  }

  Context context_;
  HostCopier copier_;
  DeviceBuffer<Point2<double>> stored_;
  DeviceBuffer<LocalFrame> frame_;
  std::vector<std::uint8_t> fixed_;           ///< as MeshRings::fixed
  FixedElements fixed_elements_;              ///< where they are asked for
  std::optional<HostUntangling> untangling_;  ///< where the mesh may have to be untangled
  std::vector<std::uint8_t> reversed_;        ///< likewise; as MeshRings::reversed
  bool is_guarded_;
  bool is_to_slide_ = false;  ///< vertices along lines, if there are any
  std::unique_ptr<DeviceSmoother> smoother_;
  double prepare_ms_ = 0;  ///< until a call has reported it
};

/// A mesh of the host with its topology found and kept on the device, which finds the local frame there as well.
class TriangleSmoother final : public PreparedSmoother {
 public:
  TriangleSmoother(std::int32_t vertex_count, std::span<const Triangle> triangles, const Constraints& constraints,
                   const SmoothingOptions& options)
      : copier_(context_, options.threads),
        constraints_(context_, checked(constraints, vertex_count, triangles.size())),
        triangles_(copier_.uploaded(triangles)),
        stored_(context_, static_cast<std::size_t>(vertex_count)),
        plan_(
            {vertex_count, static_cast<std::int32_t>(triangles.size()), triangles_.data()->data(), constraints_.view()},
            options, context_.stream()) {
    // They have been read.
    constraints_ = {};
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& /*frame*/) override {
    SmoothingResult result = smooth_host_points(context_, copier_, stored_, points, &kept_,
                                                [&] { return plan_.smooth(&stored_.data()->x, storage); });
    // The plan counts what it has taken itself.
    result.device_memory_bytes += static_cast<std::int64_t>(context_.bytes_in_use());
    return result;
  }

  std::vector<std::uint8_t> fixed() const override { return plan_.fixed(); }

 private:
  static const Constraints& checked(const Constraints& constraints, std::int32_t vertex_count,
                                    std::size_t triangle_count) {
    check_mesh_size(vertex_count, static_cast<std::int64_t>(triangle_count));
    check_constraints(constraints, vertex_count, static_cast<std::int64_t>(triangle_count));
    return constraints;
  }

  Context context_;
  HostCopier copier_;
  UploadedConstraints constraints_;
  DeviceBuffer<Triangle> triangles_;
  DeviceBuffer<Point2<double>> stored_;
  ScratchBytes kept_;
  Plan plan_;
};

/// What works on one device, whichever is current.
template <class Work>
class OnDevice : public Work {
 public:
  OnDevice(int device, std::unique_ptr<Work> work) : device_(device), work_(std::move(work)) {}
  ~OnDevice() override { after_.begin(device_); }

 protected:
  template <class Call>
  auto there(const Call& call) const {
    const DeviceScope scope(device_);
    return call(*work_);
  }

 private:
  DeviceAtEnd after_;  ///< the last to go
  int device_;
  std::unique_ptr<Work> work_;
};

class SmootherOnDevice final : public OnDevice<PreparedSmoother> {
 public:
  using OnDevice::OnDevice;

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& frame) override {
    return there([&](PreparedSmoother& smoother) { return smoother.smooth(points, storage, frame); });
  }
  std::vector<std::uint8_t> fixed() const override {
    return there([](const PreparedSmoother& smoother) { return smoother.fixed(); });
  }
};

class FollowerOnDevice final : public OnDevice<Follower> {
 public:
  using OnDevice::OnDevice;

  void follow(std::span<Point2<double>> points, Storage storage, MovingStart start, FollowResult& result) override {
    there([&](Follower& follower) { follower.follow(points, storage, start, result); });
  }
  void take_back() override {
    there([](Follower& follower) { follower.take_back(); });
  }
  void go_on_from(std::vector<Point2<double>> points) override {
    there([&](Follower& follower) { follower.go_on_from(std::move(points)); });
  }
  std::vector<Point2<double>> points() const override {
    return there([](const Follower& follower) { return follower.points(); });
  }
};

/// On a device; none: on whichever is current.
class CudaBackend final : public Backend {
 public:
  explicit CudaBackend(std::optional<int> device = std::nullopt) : device_(device) {}

  std::string name() const override { return "cuda"; }

  void require_ready() const override {
    const DeviceScope scope(device_);
    require_device();
  }

  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    return prepare_kept(mesh, elements, local, options);
  }

  bool takes_quadrilaterals() const override { return true; }
  bool takes_quadrilaterals_in_parts() const override { return true; }

  std::unique_ptr<PreparedSmoother> prepare_kept(const MeshRings& mesh, const ElementList& elements,
                                                 std::span<const Point2<double>> local,
                                                 const SmoothingOptions& options) const override {
    options.validate();
    if (!elements.are_triangles()) {
      require_quadrilaterals(options);
    }
    const DeviceScope scope(device_);
    require_device();
    if (mesh.part != nullptr && mesh.part->is_whole) {
      // Colours are by the ids of the whole mesh, which the device's own are not.
      return cpu_backend().prepare(mesh, elements, local, options);
    }
    if (mesh.part != nullptr) {
      return prepare_part(mesh, elements, local, options,
                          device_ ? part_offloads_on(*device_) : part_offloads(*mesh.part));
    }
    if (mesh.slidable.is_wanted()) {
      require_sliding(options);
    }
    if (slides_on_host(mesh, options)) {
      return cpu_backend().prepare(mesh, elements, local, options);
    }
    return on_device(std::make_unique<RingSmoother>(mesh, elements, local, options));
  }

  std::unique_ptr<Follower> follower(const MeshAtRest& mesh, MeshRings rings,
                                     const SmoothingOptions& options) const override {
    const DeviceScope scope(device_);
    require_device();
    if (!mesh.elements().are_triangles()) {
      return host_follower(mesh,
                           std::make_unique<NotedSmoother>(
                               cpu_backend().prepare(std::move(rings), mesh.elements(), mesh.local().points, options),
                               "a mesh with quadrilaterals follows its boundary on the CPU"),
                           options);
    }
    std::unique_ptr<Follower> follower = std::make_unique<DeviceFollower>(mesh, rings, options);
    return device_ ? std::make_unique<FollowerOnDevice>(*device_, std::move(follower)) : std::move(follower);
  }

  std::optional<MeshRings> find_rings(std::span<const Point2<double>> local, std::span<const Triangle> triangles,
                                      const Constraints& constraints, const SmoothingOptions& options) const override {
    const DeviceScope scope(device_);
    require_device();
    return find_rings_on_device(local, triangles, constraints, neighbour_search(options.execution),
                                options.used_layers());
  }

  std::unique_ptr<PreparedSmoother> prepare_mesh(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                                 const Constraints& constraints,
                                                 const SmoothingOptions& options) const override {
    options.validate();
    const DeviceScope scope(device_);
    require_device();
    if (constraints.slide.along != Slide::off && !can_slide(options)) {
      return nullptr;
    }
    return on_device(std::make_unique<TriangleSmoother>(vertex_count, triangles, constraints, options));
  }

 private:
  /// Whether something may slide that a device has no way for.
  static bool slides_on_host(const MeshRings& mesh, const SmoothingOptions& options) {
    return mesh.slidable.any() && (!can_slide(options) || mesh.rings.neighbours.empty());
  }
  /// Smooths where it was made.
  std::unique_ptr<PreparedSmoother> on_device(std::unique_ptr<PreparedSmoother> smoother) const {
    return device_ ? std::make_unique<SmootherOnDevice>(*device_, std::move(smoother)) : std::move(smoother);
  }

  std::optional<int> device_;
};

}  // namespace

const Backend& backend() {
  static const CudaBackend backend;
  return backend;
}

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
    return std::make_unique<CudaBackend>(devices.front());
  }
  return backend_on_several(devices);
}

}  // namespace trismooth::cuda

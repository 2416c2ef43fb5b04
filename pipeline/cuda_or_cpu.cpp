// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cuda_or_cpu.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/noted_smoother.h"

namespace trismooth {

namespace {

std::string failure_note(const DeviceError& error) {
  constexpr std::string_view prefix = "CUDA: ";
  const std::string what = error.what();
  return "CUDA failed: " + (what.starts_with(prefix) ? what.substr(prefix.size()) : what);
}

/// The device's smoother until it fails, the CPU's from then on.
class FallingBackSmoother final : public PreparedSmoother {
 public:
  FallingBackSmoother(std::unique_ptr<PreparedSmoother> device, double device_start_ms, const Backend& cpu,
                      MeshRings mesh, const ElementList& elements, const SmoothingOptions& options)
      : smoother_(std::move(device)),
        device_start_ms_(device_start_ms),
        cpu_(cpu),
        mesh_(std::move(mesh)),
        options_(options) {
    if (options.measures_shape()) {
      elements_ = OwnElements(elements);
    }
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& frame) override {
    if (!fell_back_) {
      // A device that fails on the way back has written some of them.
      const BulkVector<Point2<double>> before = copied(points);
      try {
        SmoothingResult result = smoother_->smooth(points, storage, frame);
        result.timings.prepare += std::exchange(device_start_ms_, 0);
        return result;
      } catch (const DeviceError& error) {
        std::ranges::copy(before, points.begin());
        fall_back(frame ? *frame : local_frame_of_cells(before, mesh_.fixed), before, failure_note(error));
      }
    }
    return smoother_->smooth(points, storage, frame);
  }

  std::vector<std::uint8_t> fixed() const override { return smoother_->fixed(); }

 private:
  BulkVector<Point2<double>> copied(std::span<const Point2<double>> points) const {
    constexpr std::int64_t grain = 16384;
    BulkVector<Point2<double>> copy(points.size());
    Workers(options_.threads).for_blocks(std::ssize(points), grain, [&](std::int64_t begin, std::int64_t end) {
      std::copy(points.begin() + begin, points.begin() + end, copy.begin() + begin);
    });
    return copy;
  }

  void fall_back(const LocalFrame& frame, std::span<const Point2<double>> points, std::string note) {
    const LocalPoints local = entered(frame, points);
    smoother_ = std::make_unique<NotedSmoother>(
        cpu_.prepare(std::exchange(mesh_, {}), elements_.list(), local.points, options_), std::move(note));
    elements_ = {};
    fell_back_ = true;
  }

  std::unique_ptr<PreparedSmoother> smoother_;
  double device_start_ms_;
  const Backend& cpu_;
  MeshRings mesh_;
  OwnElements elements_;  ///< where they are needed
  SmoothingOptions options_;
  bool fell_back_ = false;
};

std::int64_t count_free(const OneRings& rings, int threads) {
  constexpr std::int64_t grain = 65536;
  Workers workers(threads);
  return joined_sum(rings.vertex_count(), grain, workers,
                    [&](std::int64_t v) { return rings.is_free(static_cast<std::int32_t>(v)) ? 1 : 0; });
}

}  // namespace

CudaOrCpu::CudaOrCpu(CudaSupport cuda, const Backend& cpu, std::int64_t free_vertices)
    : cuda_(std::move(cuda)), cpu_(cpu), free_vertices_(free_vertices) {}

void CudaOrCpu::start(std::int64_t vertices) const {
  if (is_large(vertices)) {
    cuda_.problem();
  }
}

std::unique_ptr<PreparedSmoother> CudaOrCpu::prepare(MeshRings mesh, const ElementList& elements,
                                                     std::span<const Point2<double>> local,
                                                     const SmoothingOptions& options) const {
  if (!is_large(count_free(mesh.rings, options.threads))) {
    return cpu_.prepare(std::move(mesh), elements, local, options);
  }
  // The first to ask starts CUDA, which can take longer than the smoothing.
  const Stopwatch watch;
  std::string note = cuda_.problem();
  const double start_ms = watch.milliseconds();
  if (note.empty()) {
    try {
      return std::make_unique<FallingBackSmoother>(cuda_.backend->prepare_kept(mesh, elements, local, options),
                                                   start_ms, cpu_, std::move(mesh), elements, options);
    } catch (const DeviceError& error) {
      note = failure_note(error);
    }
  } else {
    note.insert(0, "no CUDA device: ");
  }
  return std::make_unique<NotedSmoother>(cpu_.prepare(std::move(mesh), elements, local, options), note);
}

std::optional<MeshRings> CudaOrCpu::find_rings(std::span<const Point2<double>> local,
                                               std::span<const Triangle> triangles, const Constraints& constraints,
                                               const SmoothingOptions& options) const {
  if (!is_large(std::ssize(local)) || !cuda_.problem().empty()) {
    return cpu_.find_rings(local, triangles, constraints, options);
  }
  try {
    return cuda_.backend->find_rings(local, triangles, constraints, options);
  } catch (const DeviceError& error) {
    // Found here, whoever else could have: so the note is with the rings that it is about.
    Workers workers(options.threads);
    MeshRings found = find_mesh_rings(local, triangles, constraints, workers, options.used_layers());
    found.note = "the CPU found the rings: " + failure_note(error);
    return found;
  }
}

}  // namespace trismooth

#include "trismooth/pipeline/auto_backend.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

std::string failure_note(const DeviceError& error) {
  constexpr std::string_view prefix = "CUDA: ";
  const std::string what = error.what();
  return "CUDA failed: " + (what.starts_with(prefix) ? what.substr(prefix.size()) : what);
}

/// A smoother, and what the user is to know of how it came about.
class NotedSmoother final : public PreparedSmoother {
 public:
  NotedSmoother(std::unique_ptr<PreparedSmoother> smoother, std::string note)
      : smoother_(std::move(smoother)), note_(std::move(note)) {}

  SmoothingResult smooth(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage,
                         double fixed_quotient) override {
    SmoothingResult result = smoother_->smooth(points, frame, storage, fixed_quotient);
    result.backend_note = joined_notes(note_, result.backend_note);
    return result;
  }

 private:
  std::unique_ptr<PreparedSmoother> smoother_;
  std::string note_;
};

/// The device's smoother until it fails, the CPU's from then on.
class FallingBackSmoother final : public PreparedSmoother {
 public:
  FallingBackSmoother(std::unique_ptr<PreparedSmoother> device, double device_start_ms, const Backend& cpu,
                      OneRings rings, SmoothingOptions options)
      : smoother_(std::move(device)),
        device_start_ms_(device_start_ms),
        cpu_(cpu),
        rings_(std::move(rings)),
        options_(std::move(options)) {}

  SmoothingResult smooth(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage,
                         double fixed_quotient) override {
    if (!fell_back_) {
      // A device that fails on the way back has written some of them.
      const std::vector<Point2<double>> before(points.begin(), points.end());
      try {
        SmoothingResult result = smoother_->smooth(points, frame, storage, fixed_quotient);
        result.timings.prepare += std::exchange(device_start_ms_, 0);
        return result;
      } catch (const DeviceError& error) {
        std::ranges::copy(before, points.begin());
        fall_back(before, frame, failure_note(error));
      }
    }
    return smoother_->smooth(points, frame, storage, fixed_quotient);
  }

 private:
  void fall_back(const std::vector<Point2<double>>& points, const LocalFrame& frame, std::string note) {
    std::vector<Point2<double>> local(points.size());
    std::ranges::transform(points, local.begin(), [&](Point2<double> p) { return frame.enter(p); });
    smoother_ = std::make_unique<NotedSmoother>(cpu_.prepare(rings_, local, options_), std::move(note));
    rings_ = {};
    fell_back_ = true;
  }

  std::unique_ptr<PreparedSmoother> smoother_;
  double device_start_ms_;
  const Backend& cpu_;
  OneRings rings_;
  SmoothingOptions options_;
  bool fell_back_ = false;
};

std::int64_t count_free(const OneRings& rings) {
  std::int64_t count = 0;
  for (std::int32_t v = 0; v < rings.vertex_count(); ++v) {
    count += rings.is_free(v) ? 1 : 0;
  }
  return count;
}

}  // namespace

AutoBackend::AutoBackend(CudaSupport cuda, const Backend& cpu, std::int64_t free_vertices)
    : cuda_(std::move(cuda)), cpu_(cpu), free_vertices_(free_vertices) {}

std::unique_ptr<PreparedSmoother> AutoBackend::prepare(const OneRings& rings, std::span<const Point2<double>> points,
                                                       const SmoothingOptions& options) const {
  if (!is_large(count_free(rings))) {
    return cpu_.prepare(rings, points, options);
  }
  // The first to ask starts CUDA, which can take longer than the smoothing.
  const auto start = std::chrono::steady_clock::now();
  std::string note = cuda_.problem();
  const double start_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (note.empty()) {
    try {
      return std::make_unique<FallingBackSmoother>(cuda_.backend->prepare(rings, points, options), start_ms, cpu_,
                                                   rings, options);
    } catch (const DeviceError& error) {
      note = failure_note(error);
    }
  } else {
    note.insert(0, "no CUDA device: ");
  }
  return std::make_unique<NotedSmoother>(cpu_.prepare(rings, points, options), note);
}

std::optional<MeshRings> AutoBackend::find_rings(std::span<const Point2<double>> points,
                                                 std::span<const Triangle> triangles, const Constraints& constraints,
                                                 const SmoothingOptions& options) const {
  if (!is_large(std::ssize(points)) || !cuda_.problem().empty()) {
    return cpu_.find_rings(points, triangles, constraints, options);
  }
  try {
    return cuda_.backend->find_rings(points, triangles, constraints, options);
  } catch (const DeviceError& error) {
    // Found here, whoever else could have: so the note is with the rings that it is about.
    Workers workers(options.threads);
    MeshRings found = find_mesh_rings(points, triangles, constraints, workers);
    found.note = "the CPU found the rings: " + failure_note(error);
    return found;
  }
}

}  // namespace trismooth

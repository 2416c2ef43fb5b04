#include "trismooth/pipeline/auto_backend.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/quality/local_frame.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

std::string failure_note(const DeviceError& error) {
  constexpr std::string_view prefix = "CUDA: ";
  const std::string what = error.what();
  return "CUDA failed: " + (what.starts_with(prefix) ? what.substr(prefix.size()) : what);
}

/// Both notes; each may be empty.
std::string joined(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

/// A smoother, and what the user is to know of how it came about.
class NotedSmoother final : public PreparedSmoother {
 public:
  NotedSmoother(std::unique_ptr<PreparedSmoother> smoother, std::string note)
      : smoother_(std::move(smoother)), note_(std::move(note)) {}

  SmoothingResult smooth(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage,
                         double fixed_quotient) override {
    SmoothingResult result = smoother_->smooth(points, frame, storage, fixed_quotient);
    result.backend_note = joined(note_, result.backend_note);
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
        result.timings.prepare += device_start_ms_;
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
  const std::string rings_note = take_rings_note();
  if (!is_large(count_free(rings))) {
    return cpu_.prepare(rings, points, options);
  }
  // The first to ask starts CUDA, which can take longer than the smoothing.
  const auto start = std::chrono::steady_clock::now();
  std::string note = cuda_.problem();
  const double start_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (note.empty()) {
    try {
      auto smoother = std::make_unique<FallingBackSmoother>(cuda_.backend->prepare(rings, points, options), start_ms,
                                                            cpu_, rings, options);
      if (rings_note.empty()) {
        return smoother;
      }
      return std::make_unique<NotedSmoother>(std::move(smoother), rings_note);
    } catch (const DeviceError& error) {
      note = failure_note(error);
    }
  } else {
    note.insert(0, "no CUDA device: ");
  }
  return std::make_unique<NotedSmoother>(cpu_.prepare(rings, points, options), joined(rings_note, note));
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
    const std::lock_guard lock(rings_note_mutex_);
    rings_note_ = "the CPU found the rings: " + failure_note(error);
  }
  return cpu_.find_rings(points, triangles, constraints, options);
}

std::string AutoBackend::take_rings_note() const {
  const std::lock_guard lock(rings_note_mutex_);
  return std::exchange(rings_note_, {});
}

}  // namespace trismooth

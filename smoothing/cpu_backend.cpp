#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/processor_name.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/sweeper.h"

namespace trismooth {

namespace {

constexpr std::int64_t vertex_grain = 8192;

class Stopwatch {
 public:
  /// Milliseconds since the last call, or since the start.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

class CpuSmoother final : public PreparedSmoother {
 public:
  CpuSmoother(const OneRings& rings, std::span<const Point2<double>> points, const SmoothingOptions& options)
      : options_(options), workers_(options.threads) {
    Stopwatch watch;
    rings_ = pack_rings(rings, points, options.form, workers_);
    prepare_ms_ = watch.lap();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage,
                         double fixed_quotient) override {
    SmoothingResult result;
    result.backend = "cpu";
    result.device = processor_name();
    result.threads = workers_.count();
    result.free_vertices = rings_.free_count();
    result.colours = rings_.colours;
    if (options_.precision == Precision::double_precision) {
      smooth_in<double>(points, frame, storage, fixed_quotient, result);
    } else {
      smooth_in<float>(points, frame, storage, fixed_quotient, result);
    }
    result.timings.prepare = std::exchange(prepare_ms_, 0);
    return result;
  }

 private:
  template <class T>
  void smooth_in(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage, double fixed_quotient,
                 SmoothingResult& result) {
    Stopwatch watch;
    std::vector<Point2<double>> before(points.size());
    std::vector<Point2<T>> working(points.size());
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      before[v] = frame.enter(points[rings_.input_index[v]]);
      working[v] = narrow<T>(before[v]);
    });
    Sweeper<T>(rings_, options_, workers_).run(working, fixed_quotient, result);
    result.timings.smooth = watch.lap();

    // Where each vertex would be stored, and what that is in the local frame.
    const auto stored = [&](std::int32_t v) {
      const Point2<double> now = points[rings_.input_index[v]];
      return working[v] == narrow<T>(before[v])
                 ? now
                 : rounded_to(storage,
                              frame.leave({static_cast<double>(working[v].x), static_cast<double>(working[v].y)},
                                          largest_stored(storage)));
    };
    std::vector<Point2<double>> after = before;
    for_vertices(rings_.free_count(), [&](std::int32_t v) { after[v] = frame.enter(stored(v)); });
    if (options_.guard) {
      const GuardOutcome outcome = keep_never_worse(rings_.view(), before, after, workers_);
      result.guard_rounds = outcome.rounds;
      result.reverted_vertices = static_cast<std::int64_t>(outcome.reverted.size());
      for (const std::int32_t v : outcome.reverted) {
        result.reverted.push_back({rings_.input_index[v], stored(v)});
      }
      std::ranges::sort(result.reverted, {}, &RevertedVertex::vertex);
    }
    std::atomic<std::int64_t> moved{0};
    workers_.for_blocks(rings_.free_count(), vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      std::int64_t moved_here = 0;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (!(after[v] == before[v])) {
          points[rings_.input_index[v]] = stored(v);
          ++moved_here;
        }
      }
      moved.fetch_add(moved_here, std::memory_order_relaxed);
    });
    result.moved_vertices = moved;
    result.timings.commit = watch.lap();
  }

  template <class T>
  static Point2<T> narrow(Point2<double> point) {
    return {static_cast<T>(point.x), static_cast<T>(point.y)};
  }

  template <class Body>
  void for_vertices(std::int32_t count, const Body& body) {
    workers_.for_blocks(count, vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        body(v);
      }
    });
  }

  SmoothingOptions options_;
  Workers workers_;
  PackedRings rings_;
  double prepare_ms_ = 0;  ///< until a call has reported it
};

class CpuBackend final : public Backend {
 public:
  std::string name() const override { return "cpu"; }

  std::unique_ptr<PreparedSmoother> prepare(const OneRings& rings, std::span<const Point2<double>> points,
                                            const SmoothingOptions& options) const override {
    options.validate();
    if (options.order == Order::unordered) {
      throw std::invalid_argument("order 'unordered' exists for CUDA only");
    }
    return std::make_unique<CpuSmoother>(rings, points, options);
  }
};

}  // namespace

const Backend& cpu_backend() {
  static const CpuBackend backend;
  return backend;
}

}  // namespace trismooth

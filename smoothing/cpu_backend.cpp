#include "trismooth/smoothing/cpu_backend.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/processor_name.h"
#include "trismooth/base/stopwatch.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/fixed_triangles.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/sweep_driver.h"

namespace trismooth {

namespace {

constexpr std::int64_t vertex_grain = 8192;

class CpuSmoother final : public PreparedSmoother {
 public:
  CpuSmoother(const MeshRings& mesh, std::span<const Triangle> triangles, std::span<const Point2<double>> local,
              const SmoothingOptions& options)
      : options_(options), workers_(options.threads), fixed_(mesh.fixed) {
    const Stopwatch watch;
    rings_ = pack_rings(mesh.rings, local, options.form, workers_);
    if (options.measures_shape()) {
      fixed_triangles_ = FixedTriangles(triangles, mesh.reversed, mesh.fixed);
    }
    prepare_ms_ = watch.milliseconds();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    const LocalFrame frame = known_frame ? *known_frame : local_frame_of_cells(points, fixed_);
    SmoothingResult result;
    result.backend = "cpu";
    result.device = processor_name();
    result.threads = workers_.count();
    result.free_vertices = rings_.free_count();
    result.colours = rings_.colours;
    if (options_.precision == Precision::double_precision) {
      smooth_in<double>(points, storage, frame, result);
    } else {
      smooth_in<float>(points, storage, frame, result);
    }
    result.timings.prepare = std::exchange(prepare_ms_, 0);
    return result;
  }

  std::vector<std::uint8_t> fixed() const override { return fixed_; }

 private:
  template <class T>
  void smooth_in(std::span<Point2<double>> points, Storage storage, const LocalFrame& frame, SmoothingResult& result) {
    Stopwatch watch;
    const double fixed_quotient =
        fixed_triangles_.smallest_quotient([&](std::int32_t v) { return frame.enter(points[v]); });
    std::vector<Point2<double>> before(points.size());
    std::vector<Point2<T>> working(points.size());
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      before[v] = frame.enter(points[rings_.input_index[v]]);
      working[v] = narrow<T>(before[v]);
    });
    SweepDriver<T>(rings_, options_, workers_).run(working, fixed_quotient, result);
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
  std::vector<std::uint8_t> fixed_;  ///< as MeshRings::fixed
  PackedRings rings_;
  FixedTriangles fixed_triangles_;  ///< where they are asked for
  double prepare_ms_ = 0;           ///< until a call has reported it
};

class CpuBackend final : public Backend {
 public:
  std::string name() const override { return "cpu"; }

  std::unique_ptr<PreparedSmoother> prepare(const MeshRings& mesh, std::span<const Triangle> triangles,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    options.validate();
    if (options.order == Order::unordered) {
      throw std::invalid_argument("order 'unordered' exists for CUDA only");
    }
    return std::make_unique<CpuSmoother>(mesh, triangles, local, options);
  }
};

}  // namespace

const Backend& cpu_backend() {
  static const CpuBackend backend;
  return backend;
}

}  // namespace trismooth

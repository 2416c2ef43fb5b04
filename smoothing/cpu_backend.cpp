#include "trismooth/smoothing/cpu_backend.h"

#include <algorithm>
#include <atomic>
#include <optional>
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
#include "trismooth/smoothing/untangle/untangle_mesh.h"

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
    if (options.measures_shape() || options.untangles()) {
      fixed_triangles_ = FixedTriangles(triangles, mesh.reversed, mesh.fixed);
    }
    if (options.untangles()) {
      triangles_.assign(triangles.begin(), triangles.end());
      reversed_ = mesh.reversed;
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
    std::vector<Point2<double>> before(points.size());
    std::vector<Point2<T>> working(points.size());
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      before[v] = frame.enter(points[rings_.input_index[v]]);
      working[v] = narrow<T>(before[v]);
    });
    std::optional<Turned> turned;
    std::vector<Point2<T>> start;  // of the sweeps, where that is not the input
    if (options_.untangles()) {
      result.timings.smooth = watch.lap();
      turned = untangle_into(working, before, result);
      if (result.untangling->inverted_before > 0) {
        start = working;
      }
      result.timings.untangle = watch.lap();
    }
    const PackedRings& rings = turned ? turned->rings : rings_;
    const FixedTriangles& fixed_triangles = turned ? turned->fixed_triangles : fixed_triangles_;
    const auto input = [&](std::int32_t v) { return frame.enter(points[v]); };
    SweepDriver<T>(rings, options_, workers_).run(working, fixed_triangles.smallest_quotient(input), result);
    result.timings.smooth += watch.lap();

    // Where each vertex would be stored, and what that is in the local frame.
    const auto stored_from = [&](const std::vector<Point2<T>>& places, std::int32_t v) {
      const Point2<double> now = points[rings_.input_index[v]];
      const Point2<T> place = places[v];
      return place == narrow<T>(before[v])
                 ? now
                 : rounded_to(storage, frame.leave({static_cast<double>(place.x), static_cast<double>(place.y)},
                                                   largest_stored(storage)));
    };
    const auto stored = [&](std::int32_t v) { return stored_from(working, v); };
    std::vector<Point2<double>> after = before;
    for_vertices(rings_.free_count(), [&](std::int32_t v) { after[v] = frame.enter(stored(v)); });
    if (options_.guard) {
      const auto guard = [&](const std::vector<Point2<double>>& from) {
        GuardOutcome outcome = keep_never_worse(rings.view(), from, after, workers_);
        result.guard_rounds += outcome.rounds;
        for (const std::int32_t v : outcome.reverted) {
          result.reverted.push_back({rings_.input_index[v], stored(v)});
        }
        return outcome;
      };
      if (!start.empty()) {
        // What the sweeps made worse goes back to where they began: the input is far from there, and who goes back that
        // far takes others along.
        std::vector<Point2<double>> untangled = before;
        for_vertices(rings_.free_count(), [&](std::int32_t v) { untangled[v] = frame.enter(stored_from(start, v)); });
        for (const std::int32_t v : guard(untangled).reverted) {
          working[v] = start[v];
        }
      }
      guard(before);
      name_once(result.reverted);
      result.reverted_vertices = std::ssize(result.reverted);
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
    if (result.untangling) {
      result.untangling->inverted_after = inverted_triangles(rings.view(), after, workers_);
      result.untangling->inverted_fixed = fixed_triangles.inverted(input);
    }
    result.timings.commit = watch.lap();
  }

  /// A mesh of which components have been turned over.
  struct Turned {
    PackedRings rings;
    FixedTriangles fixed_triangles;
  };

  /// Untangles `before` into `working`. Returns the mesh to go on with where it had to be turned over.
  template <class T>
  std::optional<Turned> untangle_into(std::vector<Point2<T>>& working, const std::vector<Point2<double>>& before,
                                      SmoothingResult& result) {
    std::vector<Point2<double>> untangled = before;
    const MeshUntangling done = untangle_mesh(rings_.view(), triangles_, reversed_, untangled, workers_);
    result.untangling = {.inverted_before = done.outcome.inverted_before,
                         .inverted_untangled = done.outcome.inverted_after,
                         .turned_components = done.turned_components};
    if (done.outcome.inverted_before == 0) {
      return std::nullopt;
    }
    for_vertices(rings_.free_count(), [&](std::int32_t v) { working[v] = narrow<T>(untangled[v]); });
    if (done.turned.empty()) {
      return std::nullopt;
    }
    Turned turned{rings_, FixedTriangles(triangles_, done.reversed, fixed_)};
    turn_rings(turned.rings.offsets, done.turned, turned.rings.neighbours);
    return turned;
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
  FixedTriangles fixed_triangles_;      ///< where they are asked for
  std::vector<Triangle> triangles_;     ///< of the mesh, where it may have to be untangled
  std::vector<std::uint8_t> reversed_;  ///< as MeshRings::reversed, likewise
  double prepare_ms_ = 0;               ///< until a call has reported it
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

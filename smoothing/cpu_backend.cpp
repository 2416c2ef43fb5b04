#include "trismooth/smoothing/cpu_backend.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <stdexcept>
#include <utility>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/prefetch.h"
#include "trismooth/base/processor_name.h"
#include "trismooth/base/stopwatch.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/fixed_triangles.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/slide/packed_slidable.h"
#include "trismooth/smoothing/slide/slide_guard.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"
#include "trismooth/smoothing/sweeps/slide_pass.h"
#include "trismooth/smoothing/sweeps/sweep_driver.h"
#include "trismooth/smoothing/untangle/untangle.h"
#include "trismooth/smoothing/untangle/untangle_mesh.h"

namespace trismooth {

namespace {

constexpr std::int64_t vertex_grain = 8192;
constexpr std::int32_t vertices_ahead = 32;

class CpuSmoother final : public PreparedSmoother {
 public:
  CpuSmoother(MeshRings mesh, std::span<const Triangle> triangles, std::span<const Point2<double>> local,
              const SmoothingOptions& options)
      : options_(options), workers_(options.threads), fixed_(std::move(mesh.fixed)) {
    const Stopwatch watch;
    rings_ = pack_rings(std::move(mesh.rings), local, options.form, workers_);
    if (options.measures_shape() || options.untangles()) {
      // Those of vertices that may slide are in the chains.
      fixed_triangles_ = FixedTriangles(triangles, mesh.reversed, mesh.slidable.truly_fixed(fixed_), workers_);
    }
    if (mesh.slidable.any()) {
      slidable_ = PackedSlidable(std::move(mesh.slidable), mesh.reversed, rings_.input_index);
    }
    if (options.untangles()) {
      triangles_.assign(triangles.begin(), triangles.end());
      reversed_ = std::move(mesh.reversed);
    }
    prepare_ms_ = watch.milliseconds();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    inverse_sizes_ = inverse_sizes(options_, fixed_);
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
    BulkVector<Point2<double>> before(points.size());
    BulkVector<Point2<T>> working(points.size());
    const std::int32_t last = rings_.vertex_count() - 1;
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      // The caller's numbers may be at random.
      prefetch(&points[rings_.input_index[v + std::min(vertices_ahead, last - v)]]);
      before[v] = frame.enter(points[rings_.input_index[v]]);
      working[v] = narrow<T>(before[v]);
    });
    std::optional<Turned> turned;
    BulkVector<Point2<T>> start;  // of the sweeps, where that is not the input
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
    // (Where components are turned over their chains are, too, and what is on which side of them.)
    const SlideChains chains =
        slidable_.any() && !turned ? slidable_.chains(points, before, storage, frame) : SlideChains{};
    std::optional<SlidePass<T>> slide;
    HeldNeighbours held;
    if (chains.any()) {
      slide.emplace(chains, workers_);
      held = chains.neighbours(rings_.free_count(), rings_.vertex_count());
    }
    double fixed_quotient = fixed_triangles.smallest_quotient(input);
    if (!slide) {
      fixed_quotient = std::min(fixed_quotient, chains.smallest_quotient(std::span<const Point2<double>>(before)));
    }
    SweepDriver<T>(rings, options_, workers_, inverse_sizes_, slide ? &*slide : nullptr)
        .run(working, fixed_quotient, result);
    result.timings.smooth += watch.lap();

    // Where each vertex would be stored, and what that is in the local frame.
    const auto stored_from = [&](const BulkVector<Point2<T>>& places, std::int32_t v) -> Point2<double> {
      const Point2<T> place = places[v];
      if (place == narrow<T>(before[v])) {
        return points[rings_.input_index[v]];
      }
      return rounded_to(
          storage, frame.leave({static_cast<double>(place.x), static_cast<double>(place.y)}, largest_stored(storage)));
    };
    // (What would be stored where it was is not fetched for that.)
    const auto entered_from = [&](const BulkVector<Point2<T>>& places, std::int32_t v) {
      return places[v] == narrow<T>(before[v]) ? before[v] : frame.enter(stored_from(places, v));
    };
    const auto stored = [&](std::int32_t v) { return stored_from(working, v); };
    BulkVector<Point2<double>> after(before.size());
    for_vertices(rings_.vertex_count(),
                 [&](std::int32_t v) { after[v] = v < rings_.free_count() ? entered_from(working, v) : before[v]; });
    const std::vector<SlidVertex> slid =
        slide ? slid_vertices(chains, slide->places(), frame, storage) : std::vector<SlidVertex>{};
    for (const SlidVertex& vertex : slid) {
      after[vertex.vertex] = frame.enter(vertex.stored);
    }
    const auto list = [&](std::span<const std::int32_t> reverted) {
      for (const std::int32_t v : reverted) {
        const auto slider = std::ranges::lower_bound(slid, v, {}, &SlidVertex::vertex);
        const bool slides = slider != slid.end() && slider->vertex == v;
        result.reverted.push_back({rings_.input_index[v], slides ? slider->stored : stored(v)});
      }
    };
    const auto guarded = [&](const GuardOutcome& outcome) {
      result.guard_rounds += outcome.rounds;
      list(outcome.reverted);
      return !outcome.reverted.empty() && outcome.reverted.back() >= rings_.free_count();
    };
    if (options_.guard && !start.empty()) {
      // What the sweeps made worse goes back to where they began: the input is far from there, and who goes back that
      // far takes others along.
      BulkVector<Point2<double>> untangled = before;
      for_vertices(rings_.free_count(), [&](std::int32_t v) { untangled[v] = entered_from(start, v); });
      const GuardOutcome outcome = keep_never_worse(rings.view(), untangled, after, workers_, held);
      guarded(outcome);
      for (const std::int32_t v : outcome.reverted) {
        if (v < rings_.free_count()) {
          working[v] = start[v];
        }
      }
    }
    if (slide) {
      // Lines and elements have their say in turn: who goes back for one may spoil the other.
      SlideGuard lines(chains, slide->places(), before, after, options_.guard);
      bool again = true;
      while (again) {
        std::vector<std::int32_t> reverted;
        result.guard_rounds += lines.settle(reverted);
        list(reverted);
        again = options_.guard && guarded(keep_never_worse(rings.view(), before, after, workers_, held));
      }
      const LineDeviation deviation = lines.deviation();
      result.sliding = {.chains = std::ssize(chains.chains),
                        .vertices = chains.vertex_count(),
                        .slid = lines.slid_vertices(),
                        .largest_deviation = deviation.distance * frame.length_scale(),
                        .relative_deviation = deviation.relative};
    } else if (options_.guard && turned) {
      guarded(keep_never_worse(rings.view(), triangles_, reversed_, turned->components, before, after, workers_));
    } else if (options_.guard) {
      guarded(keep_never_worse(rings.view(), before, after, workers_));
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
    for (const SlidVertex& vertex : slid) {
      if (!(after[vertex.vertex] == before[vertex.vertex])) {
        points[rings_.input_index[vertex.vertex]] = vertex.stored;
        ++moved;
      }
    }
    result.moved_vertices = moved;
    name_reverted(result, points);
    if (result.untangling) {
      count_inverted(turned ? turned->components : TurnedComponents{}, after, input, *result.untangling);
      result.untangling->inverted_fixed += chains.inverted(after);
    }
    result.timings.commit = watch.lap();
  }

  /// The mesh with components turned over.
  struct Turned {
    TurnedComponents components;
    PackedRings rings;
    FixedTriangles fixed_triangles;
  };

  FixedTriangles fixed_triangles(const TurnedComponents& turned) {
    return {triangles_, turned_over(reversed_, turned), fixed_, workers_};
  }

  Turned turn(TurnedComponents components) {
    Turned turned{std::move(components), rings_, {}};
    turned.rings.neighbours = turned_neighbours(rings_.view(), triangles_, turned.components);
    turned.fixed_triangles = fixed_triangles(turned.components);
    return turned;
  }

  /// What is inverted at `after`, where the guard has left those components turned over.
  template <class Input>
  void count_inverted(const TurnedComponents& turned, std::span<const Point2<double>> after, const Input& input,
                      UntanglingResult& result) {
    // The guard lets nothing that was valid become inverted.
    result.inverted_after = options_.guard && result.inverted_before == 0
                                ? 0
                                : inverted_triangles(rings_.view(), triangles_, turned, after, workers_);
    result.inverted_fixed = (turned.any() ? fixed_triangles(turned) : fixed_triangles_).inverted(input);
    result.turned_components = turned.count;
    result.turned = turned.triangles;
  }

  /// Untangles `before` into `working`. Returns the mesh to go on with where it had to be turned over.
  template <class T>
  std::optional<Turned> untangle_into(BulkVector<Point2<T>>& working, const BulkVector<Point2<double>>& before,
                                      SmoothingResult& result) {
    result.untangling.emplace();
    if (inverted_triangles(rings_.view(), before, workers_) == 0) {
      return std::nullopt;
    }
    BulkVector<Point2<double>> untangled = before;
    MeshUntangling done = untangle_mesh(rings_.view(), triangles_, reversed_, untangled, workers_);
    result.untangling = {.inverted_before = done.inverted_before, .inverted_untangled = done.inverted_after};
    for_vertices(rings_.free_count(), [&](std::int32_t v) { working[v] = narrow<T>(untangled[v]); });
    return done.turned.any() ? std::optional(turn(std::move(done.turned))) : std::nullopt;
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
  PackedSlidable slidable_;
  FixedTriangles fixed_triangles_;      ///< where they are asked for
  std::vector<Triangle> triangles_;     ///< of the mesh, where it may have to be untangled
  std::vector<std::uint8_t> reversed_;  ///< as MeshRings::reversed, likewise
  std::vector<double> inverse_sizes_;   ///< that are asked for, in a call; empty: none
  double prepare_ms_ = 0;               ///< until a call has reported it
};

class CpuBackend final : public Backend {
 public:
  std::string name() const override { return "cpu"; }

  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, std::span<const Triangle> triangles,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    options.validate();
    if (options.order == Order::unordered) {
      throw std::invalid_argument("order 'unordered' exists for CUDA only");
    }
    return std::make_unique<CpuSmoother>(std::move(mesh), triangles, local, options);
  }
};

}  // namespace

const Backend& cpu_backend() {
  static const CpuBackend backend;
  return backend;
}

}  // namespace trismooth

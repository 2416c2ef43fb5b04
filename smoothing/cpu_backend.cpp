// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/cpu_backend.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/prefetch.h"
#include "trismooth/base/machine/processor_name.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/rings/fixed_elements.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/slide/packed_slidable.h"
#include "trismooth/smoothing/slide/slid_vertices.h"
#include "trismooth/smoothing/slide/slide_guard.h"
#include "trismooth/smoothing/sweeps/proposed_update.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"
#include "trismooth/smoothing/sweeps/slide_pass.h"
#include "trismooth/smoothing/sweeps/sweep_driver.h"
#include "trismooth/smoothing/sweeps/sweep_offload.h"
#include "trismooth/smoothing/untangle/untangle.h"
#include "trismooth/smoothing/untangle/untangle_mesh.h"

namespace trismooth {

namespace {

constexpr std::int64_t vertex_grain = 8192;
constexpr std::int32_t vertices_ahead = 32;

constexpr const char* untangling_over_parts =
    "the mesh has inverted triangles, and those of a mesh in parts are not untangled";

class CpuSmoother final : public PreparedSmoother {
 public:
  CpuSmoother(MeshRings mesh, const ElementList& elements, std::span<const Point2<double>> local,
              const SmoothingOptions& options, std::unique_ptr<SweepOffloads> offloads)
      : options_(options),
        offloads_(std::move(offloads)),
        workers_(options.threads),
        fixed_(std::move(mesh.fixed)),
        part_(std::move(mesh.part)) {
    const Stopwatch watch;
    rings_ = pack_rings(std::move(mesh.rings), local, options.form, workers_, part_.get());
    if (part_ != nullptr && !part_->is_whole) {
      halo_.emplace(*part_, rings_);
      if (offloads_ != nullptr && options.precision == Precision::single_precision) {
        in_single_ = offloads_->in_single(rings_, *halo_, options_);
      } else if (offloads_ != nullptr) {
        in_double_ = offloads_->in_double(rings_, *halo_, options_);
      }
    }
    if (options.measures_shape() || options.untangles()) {
      // Those of vertices that may slide are in the chains.
      fixed_elements_ = FixedElements(elements, mesh.reversed, mesh.slidable.truly_fixed(fixed_), workers_,
                                      part_ != nullptr ? part_->ghosts : std::span<const std::uint8_t>());
    }
    if (mesh.slidable.is_wanted()) {
      std::vector<std::int32_t> numbers = packed_numbers(mesh.slidable, rings_.input_index);
      const std::vector<std::uint8_t> reversed = mesh.slidable.flags_of_elements(mesh.reversed);
      slidable_ = PackedSlidable(std::move(mesh.slidable), reversed, std::move(numbers));
    }
    if (options.untangles()) {
      elements_ = OwnElements(elements);
      reversed_ = std::move(mesh.reversed);
    }
    prepare_ms_ = watch.milliseconds();
  }

  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                         const std::optional<LocalFrame>& known_frame) override {
    inverse_sizes_ = inverse_sizes(options_, fixed_, halo());
    const LocalFrame frame = known_frame ? *known_frame : local_frame_of_cells(points, fixed_);
    SmoothingResult result =
        with_sliding_unless_given_up([&](bool slides) { return smoothed(points, storage, frame, slides); });
    result.timings.prepare = std::exchange(prepare_ms_, 0);
    return result;
  }

  void aim_at(std::span<const Point2<double>> reference, const LocalFrame& frame) override {
    if (options_.precision == Precision::double_precision) {
      in_double_reference_ = reference_targets<double>(reference, frame);
    } else {
      in_single_reference_ = reference_targets<float>(reference, frame);
    }
    reference_exponent_ = frame.exponent;
  }

  std::vector<std::uint8_t> fixed() const override { return fixed_; }

 private:
  /// The mesh with components turned over.
  struct Turned {
    TurnedComponents components;
    PackedRings rings;
    FixedElements fixed_elements;
  };

  /// One call: the caller's points, and what becomes of them, packed and in the local frame.
  template <class T>
  struct Run {
    std::span<Point2<double>> points;
    Storage storage;
    const LocalFrame& frame;
    bool slides;  ///< what may slide does
    SmoothingResult& result;
    BulkVector<Point2<double>> before;
    BulkVector<Point2<T>> working;
    BulkVector<Point2<T>> start;   ///< of the sweeps, where that is not the input
    std::optional<Turned> turned;  ///< the mesh to go on with, where it is another one
    SlideChains chains;
    std::optional<SlidePass<T>> slide;  ///< where a vertex slides on them
    BulkVector<Point2<double>> after;   ///< as it would be stored
    SlidVertices slid;
  };

  /// `slides`: unless nothing is to. Where that is given up the points are as they were.
  SmoothingResult smoothed(std::span<Point2<double>> points, Storage storage, const LocalFrame& frame, bool slides) {
    SmoothingResult result;
    result.backend = "cpu";
    result.device = processor_name();
    result.threads = workers_.count();
    if (offloads_ != nullptr) {
      result.backend = offloads_->backend();
      result.device = offloads_->device();
      result.threads = 0;
    }
    result.free_vertices = part_ == nullptr ? rings_.free_count() : part_->free_vertices;
    result.colours = rings_.colours;
    if (options_.precision == Precision::double_precision) {
      smooth_in<double>(points, storage, frame, slides, result);
    } else {
      smooth_in<float>(points, storage, frame, slides, result);
    }
    return result;
  }

  template <class T>
  void smooth_in(std::span<Point2<double>> points, Storage storage, const LocalFrame& frame, bool slides,
                 SmoothingResult& result) {
    Stopwatch watch;
    Run<T> run{points, storage, frame, slides, result, {}, {}, {}, {}, {}, {}, {}, {}};
    enter(run);
    if (CallLimit* const limit = CallLimit::current()) {
      // The guard takes several times as long as this, with what is written behind it: found by experiment.
      constexpr double entries_of_guard = 6;
      limit->keep_back(limit->kept_back().value_or(0) + behind_sweeps_.value_or(entries_of_guard * watch.seconds()));
    }
    if (options_.untangles()) {
      result.timings.smooth = watch.lap();
      run.turned = untangle_into(run.working, run.before, result);
      if (result.untangling->inverted_before > 0) {
        run.start = run.working;
      }
      result.timings.untangle = watch.lap();
    }
    sweep(run);
    result.timings.smooth += watch.lap();
    lay_out(run);
    guard(run);
    if (!(result.sliding && result.sliding->given_up)) {
      store(run);
    }
    result.timings.commit = watch.lap();
    if (result.sweeps > 0) {
      behind_sweeps_ = 1e-3 * result.timings.commit;
    }
  }

  template <class T>
  void enter(Run<T>& run) {
    run.before.resize(run.points.size());
    run.working.resize(run.points.size());
    const std::int32_t last = rings_.vertex_count() - 1;
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      // The caller's numbers may be at random.
      prefetch(&run.points[rings_.input_index[v + std::min(vertices_ahead, last - v)]]);
      run.before[v] = run.frame.enter(run.points[rings_.input_index[v]]);
      run.working[v] = narrow<T>(run.before[v]);
    });
  }

  template <class T>
  void sweep(Run<T>& run) {
    const PackedRings& rings = run.turned ? run.turned->rings : rings_;
    const FixedElements& fixed_elements = run.turned ? run.turned->fixed_elements : fixed_elements_;
    if (slidable_.slidable().is_wanted()) {
      run.result.sliding.emplace();
    }
    if (slidable_.any() && !run.turned) {
      // (Where components are turned over, so is what is on which side of their lines.)
      run.chains = chains_at(run.points, run.storage, run.frame);
      run.result.sliding = run.chains.result();
    }
    if (run.chains.any() && run.slides) {
      run.slide.emplace(run.chains, workers_);
    }
    double fixed_quotient = least_of_parts(
        halo(), fixed_elements.smallest_quotient([&](std::int32_t v) { return run.frame.enter(run.points[v]); }));
    if (!run.slide) {
      fixed_quotient =
          std::min(fixed_quotient, run.chains.smallest_quotient(std::span<const Point2<double>>(run.before)));
    }
    const ProposedUpdate<T> proposed(options_.proposal, run.frame, rings.input_index);
    std::optional<ReferenceTargets<T>>& reference = reference_in<T>();
    if (reference) {
      reference->exponents = run.frame.exponent - reference_exponent_;
    }
    SweepDriver<T>(rings, options_, workers_, inverse_sizes_, run.slide ? &*run.slide : nullptr, halo(), offload<T>(),
                   options_.proposal ? &proposed : nullptr, reference ? &*reference : nullptr)
        .run(run.working, fixed_quotient, run.result);
  }

  /// Where a vertex would be stored if it were at its one of `places`.
  template <class T>
  Point2<double> stored_from(const Run<T>& run, const BulkVector<Point2<T>>& places, std::int32_t v) const {
    const Point2<T> place = places[v];
    if (place == narrow<T>(run.before[v])) {
      return run.points[rings_.input_index[v]];
    }
    return rounded_to(run.storage, run.frame.leave({static_cast<double>(place.x), static_cast<double>(place.y)},
                                                   largest_stored(run.storage)));
  }
  /// What that is in the local frame. (What would be stored where it was is not fetched for that.)
  template <class T>
  Point2<double> entered_from(const Run<T>& run, const BulkVector<Point2<T>>& places, std::int32_t v) const {
    return places[v] == narrow<T>(run.before[v]) ? run.before[v] : run.frame.enter(stored_from(run, places, v));
  }

  /// Finds where all vertices would be stored.
  template <class T>
  void lay_out(Run<T>& run) {
    run.after.resize(run.before.size());
    for_vertices(rings_.vertex_count(), [&](std::int32_t v) {
      run.after[v] = v < rings_.free_count() ? entered_from(run, run.working, v) : run.before[v];
    });
    if (halo() != nullptr) {
      halo()->update(std::span<Point2<double>>(run.after));
    }
    if (run.slide) {
      run.slid = SlidVertices(run.chains, run.slide->places(), run.frame, run.storage);
    }
    for (const SlidVertex& slid : run.slid) {
      run.after[slid.vertex] = run.frame.enter(slid.stored);
    }
  }

  /// Lists vertices that went back, with where they would have been stored.
  template <class T>
  void list(Run<T>& run, std::span<const std::int32_t> reverted) {
    for (const std::int32_t v : reverted) {
      const SlidVertex* const slid = run.slid.find(v);
      run.result.reverted.push_back(
          {rings_.input_index[v], slid != nullptr ? slid->stored : stored_from(run, run.working, v)});
    }
  }

  template <class T>
  void list(Run<T>& run, const GuardOutcome& outcome) {
    run.result.guard_rounds += outcome.rounds;
    list(run, std::span<const std::int32_t>(outcome.reverted));
  }

  template <class T>
  void guard(Run<T>& run) {
    const PackedRings& rings = run.turned ? run.turned->rings : rings_;
    if (halo() != nullptr) {
      if (options_.guard) {
        list(run, keep_never_worse(rings.view(), run.before, run.after, workers_, halo()->around_ghosts(), halo()));
      }
      return;
    }
    const NumberLists held =
        run.slide ? run.chains.neighbours(rings_.free_count(), rings_.vertex_count()) : NumberLists();
    if (options_.guard && !run.start.empty()) {
      // What the sweeps made worse goes back to where they began: the input is far from there, and who goes back that
      // far takes others along.
      BulkVector<Point2<double>> untangled = run.before;
      for_vertices(rings_.free_count(), [&](std::int32_t v) { untangled[v] = entered_from(run, run.start, v); });
      const GuardOutcome outcome = keep_never_worse(rings.view(), untangled, run.after, workers_, held);
      list(run, outcome);
      for (const std::int32_t v : outcome.reverted) {
        if (v < rings_.free_count()) {
          run.working[v] = run.start[v];
        }
      }
    }
    if (run.slide) {
      guard_with_lines(run, held);
    } else if (options_.guard && run.turned) {
      list(run, keep_never_worse(rings.view(), elements_.list(), reversed_, run.turned->components, run.before,
                                 run.after, workers_));
    } else if (options_.guard) {
      list(run, keep_never_worse(rings.view(), run.before, run.after, workers_));
    }
  }

  template <class T>
  void guard_with_lines(Run<T>& run, const NumberLists& held) {
    SlideGuard lines(run.chains, run.slide->places(), run.before, run.after);
    std::vector<std::int32_t> reverted;
    const auto guard_elements = [&] {
      const GuardOutcome outcome = keep_never_worse(rings_.view(), run.before, run.after, workers_, held);
      reverted.insert(reverted.end(), outcome.reverted.begin(), outcome.reverted.end());
      return ElementRounds{outcome.rounds, outcome.threshold,
                           !outcome.reverted.empty() && outcome.reverted.back() >= rings_.free_count()};
    };
    run.result.guard_rounds += settle_in_turn(
        options_.guard, [&] { return lines.settle(reverted); }, guard_elements,
        [&](double threshold) { return lines.settle_held_elements(threshold, reverted); });
    list(run, std::span<const std::int32_t>(reverted));
    SlidingResult& sliding = *run.result.sliding;
    if (ran_to_its_end(run.result.stop_reason) &&
        is_spoilt_by_sliding(std::ssize(reverted), rings_.free_count() + sliding.vertices)) {
      sliding.given_up = true;
      return;
    }
    const LineDeviation deviation = lines.deviation();
    sliding.slid = lines.slid_vertices();
    sliding.largest_deviation = std::ldexp(deviation.distance, run.frame.exponent);
    sliding.relative_deviation = deviation.relative;
  }

  /// Writes what is elsewhere to the caller's points.
  template <class T>
  void store(Run<T>& run) {
    std::atomic<std::int64_t> moved{0};
    workers_.for_blocks(rings_.free_count(), vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      std::int64_t moved_here = 0;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (!(run.after[v] == run.before[v])) {
          run.points[rings_.input_index[v]] = stored_from(run, run.working, v);
          ++moved_here;
        }
      }
      moved.fetch_add(moved_here, std::memory_order_relaxed);
    });
    // The input, by the caller's numbers, is needed until here.
    const auto input = [&](std::int32_t v) { return run.frame.enter(run.points[v]); };
    if (run.result.untangling) {
      count_inverted(run.turned ? run.turned->components : TurnedComponents{}, run.after, input,
                     *run.result.untangling);
      run.result.untangling->inverted_fixed += run.chains.inverted(run.after);
    }
    for (const SlidVertex& slid : run.slid) {
      if (!(run.after[slid.vertex] == run.before[slid.vertex])) {
        Point2<double>& point = run.points[rings_.input_index[slid.vertex]];
        point = with_kept_bits(point, slid.stored);
        ++moved;
      }
    }
    run.result.moved_vertices = sum_of_parts(halo(), moved);
    name_reverted(run.result, run.points);
  }

  /// What slides, in packed numbers.
  SlideChains chains_at(std::span<const Point2<double>> points, Storage storage, const LocalFrame& frame) const {
    if (!slidable_.any()) {
      return {};
    }
    std::vector<Point2<double>> stored;
    for (const std::int32_t v : slidable_.slidable().vertices) {
      stored.push_back(points[v]);
    }
    SlideChains chains = slidable_.chains(stored, storage, frame);
    chains.renumber(slidable_.numbers(), slidable_.packed_elements());
    return chains;
  }

  FixedElements fixed_elements(const TurnedComponents& turned) {
    return {elements_.list(), turned_over(reversed_, turned), fixed_, workers_};
  }

  Turned turn(TurnedComponents components) {
    Turned turned{std::move(components), rings_, {}};
    TurnedRings rings = turned_rings(rings_.view(), elements_.list(), turned.components);
    turned.rings.neighbours = std::move(rings.neighbours);
    turned.rings.opposites = std::move(rings.opposites);
    turned.fixed_elements = fixed_elements(turned.components);
    return turned;
  }

  /// What is inverted at `after`, where the guard has left those components turned over.
  template <class Input>
  void count_inverted(const TurnedComponents& turned, std::span<const Point2<double>> after, const Input& input,
                      UntanglingResult& result) {
    // The guard lets nothing that was valid become inverted.
    result.inverted_after = options_.guard && result.inverted_before == 0 ? 0
                            : halo() != nullptr
                                ? sum_of_parts(halo(), inverted_elements_of_part(rings_, after))
                                : inverted_elements(rings_.view(), elements_.list(), turned, after, workers_);
    result.inverted_fixed =
        sum_of_parts(halo(), (turned.any() ? fixed_elements(turned) : fixed_elements_).inverted(input));
    result.turned_components = turned.count;
    result.turned = turned.elements;
  }

  /// Untangles `before` into `working`. Returns the mesh to go on with where it had to be turned over.
  template <class T>
  std::optional<Turned> untangle_into(BulkVector<Point2<T>>& working, const BulkVector<Point2<double>>& before,
                                      SmoothingResult& result) {
    result.untangling.emplace();
    const Stopwatch watch;
    if (!any_part(halo(), inverted_elements(rings_.view(), before, workers_) > 0)) {
      return std::nullopt;
    }
    // The guard of what is untangled measures all twice, and again what it takes back: found by experiment.
    constexpr double looks_of_guard = 8;
    const double guard_takes = behind_sweeps_.value_or(looks_of_guard * watch.seconds());
    if (halo() != nullptr) {
      throw PartsError(untangling_over_parts);
    }
    BulkVector<Point2<double>> untangled = before;
    MeshUntangling done;
    {
      std::optional<CallLimit> sooner;
      if (CallLimit* const limit = CallLimit::current(); limit != nullptr && !limit->is_lifted()) {
        sooner.emplace(options_.time_limit_seconds - guard_takes, *limit);
      }
      done = untangle_mesh(rings_.view(), elements_.list(), reversed_, untangled, workers_);
    }
    if (CallLimit* const limit = CallLimit::current()) {
      limit->lift();  // what is untangled is kept
      limit->keep_back(std::max(limit->kept_back().value_or(0), guard_takes));
    }
    result.untangling = {.inverted_before = done.inverted_before, .inverted_untangled = done.inverted_after};
    for_vertices(rings_.free_count(), [&](std::int32_t v) { working[v] = narrow<T>(untangled[v]); });
    return done.turned.any() ? std::optional(turn(std::move(done.turned))) : std::nullopt;
  }

  template <class T>
  static Point2<T> narrow(Point2<double> point) {
    return {static_cast<T>(point.x), static_cast<T>(point.y)};
  }

  /// Null: the sweeps are made here.
  template <class T>
  SweepOffload<T>* offload() {
    if constexpr (std::is_same_v<T, float>) {
      return in_single_.get();
    } else {
      return in_double_.get();
    }
  }

  template <class T>
  std::optional<ReferenceTargets<T>>& reference_in() {
    if constexpr (std::is_same_v<T, float>) {
      return in_single_reference_;
    } else {
      return in_double_reference_;
    }
  }
  template <class T>
  ReferenceTargets<T> reference_targets(std::span<const Point2<double>> reference, const LocalFrame& frame) {
    ReferenceTargets<T> found;
    found.points.resize(reference.size());
    for_vertices(rings_.vertex_count(),
                 [&](std::int32_t v) { found.points[v] = narrow<T>(frame.enter(reference[rings_.input_index[v]])); });
    found.targets = HostTargets<T>(found.points, rings_, options_.mean_ratio, workers_, {}, halo());
    return found;
  }

  /// Null: the mesh is no part of another one.
  Halo* halo() { return halo_ ? &*halo_ : nullptr; }

  template <class Body>
  void for_vertices(std::int32_t count, const Body& body) {
    workers_.for_blocks(count, vertex_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        body(v);
      }
    });
  }

  SmoothingOptions options_;
  std::unique_ptr<SweepOffloads> offloads_;
  Workers workers_;
  std::vector<std::uint8_t> fixed_;  ///< as MeshRings::fixed
  std::shared_ptr<const MeshPart> part_;
  PackedRings rings_;
  std::optional<Halo> halo_;
  std::unique_ptr<SweepOffload<float>> in_single_;  ///< one of these, where sweeps are made elsewhere
  std::unique_ptr<SweepOffload<double>> in_double_;
  PackedSlidable slidable_;
  FixedElements fixed_elements_;                                ///< where they are asked for
  OwnElements elements_;                                        ///< of the mesh, where it may have to be untangled
  std::vector<std::uint8_t> reversed_;                          ///< as MeshRings::reversed, likewise
  std::vector<double> inverse_sizes_;                           ///< that are asked for, in a call; empty: none
  std::optional<ReferenceTargets<float>> in_single_reference_;  ///< see aim_at(); one of these at most
  std::optional<ReferenceTargets<double>> in_double_reference_;
  int reference_exponent_ = 0;           ///< of its frame
  std::optional<double> behind_sweeps_;  ///< seconds that guard and writing took in the last call that came so far
  double prepare_ms_ = 0;                ///< until a call has reported it
};

class CpuBackend final : public Backend {
 public:
  std::string name() const override { return "cpu"; }

  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override {
    require_available(options, mesh);
    return std::make_unique<CpuSmoother>(std::move(mesh), elements, local, options, nullptr);
  }

  bool takes_quadrilaterals() const override { return true; }
  bool takes_quadrilaterals_in_parts() const override { return true; }

 private:
  static void require_available(const SmoothingOptions& options, const MeshRings& mesh) {
    options.validate();
    if (options.order == Order::unordered) {
      throw std::invalid_argument("order 'unordered' exists for CUDA only");
    }
    if (options.proposal && mesh.slidable.is_wanted()) {
      throw std::invalid_argument("a proposal says nothing of vertices that slide: without sliding");
    }
  }
};

}  // namespace

std::unique_ptr<PreparedSmoother> prepare_part(MeshRings mesh, const ElementList& elements,
                                               std::span<const Point2<double>> local, const SmoothingOptions& options,
                                               std::unique_ptr<SweepOffloads> offloads) {
  return std::make_unique<CpuSmoother>(std::move(mesh), elements, local, options, std::move(offloads));
}

const Backend& cpu_backend() {
  static const CpuBackend backend;
  return backend;
}

}  // namespace trismooth

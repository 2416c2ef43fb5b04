// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/device_smoother.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "trismooth/base/machine/call_limit.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/run_record.h"
#include "trismooth/cuda/runtime/timeline.h"
#include "trismooth/cuda/sliding_run.h"
#include "trismooth/cuda/sweep_engine.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_batches.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"
#include "trismooth/smoothing/sweeps/sweep_control.h"

namespace trismooth::cuda {

namespace {

/// Drives an engine in working precision T from stored coordinates to stored coordinates.
template <class T>
class EngineSmoother final : public DeviceSmoother {
 public:
  EngineSmoother(Context& context, PackedMesh mesh, const SmoothingOptions& options)
      : context_(context),
        options_(options),
        device_(require_device()),
        order_(std::move(mesh.order)),
        before_(context, static_cast<std::size_t>(order_.vertex_count())),
        record_(context, 1),
        timeline_(context) {
    if (order_.free_count() > 0) {
      engine_.emplace(make_sweep_engine<T>(context, order_, std::move(mesh.rings), options));
      if (options.guard) {
        guard_buffers_ = GuardBuffers(context, order_.free_count(), order_.vertex_count());
      }
    }
  }

  void slide_on(Slidable slidable, std::vector<std::uint8_t> reversed) override {
    slides_.allow(context_, order_, std::move(slidable), std::move(reversed));
  }

  void aim_at(const Point2<double>* stored, const LocalFrame* frame, int exponent) override {
    if (engine_) {
      with_engine([&](auto& engine) {
        const auto [first, second] = engine.input();
        enter_frame_packed(context_, stored, order_, frame, before_.data(), first, second);
        engine.aim_at_input(exponent);
      });
    }
  }

  bool has_free_vertices() const override { return engine_.has_value(); }

  bool is_tangled(const Point2<double>* stored, const LocalFrame* frame) override {
    if (!engine_) {
      return false;
    }
    host_record_ = RunRecord{};
    record_.upload({&host_record_, 1});
    with_engine([&](auto& engine) {
      const auto [first, second] = engine.input();
      enter_frame_packed(context_, stored, order_, frame, before_.data(), first, second);
      static_assert(sizeof(Point2<double>) == sizeof(PointRecord<double>));
      launch_smallest_quotient(engine.rings(),
                               PointArray<double>{reinterpret_cast<PointRecord<double>*>(before_.data())},
                               record_.data()->sums.data(), context_.stream());
    });
    record_.download({&host_record_, 1});
    // Seen from another corner a quotient may be rounded to the other side of 0.
    constexpr double surely_positive = 1e-12;
    return from_falling_key(host_record_.sums.front().min_quotient) < surely_positive;
  }

  void read_sizes(std::span<const std::uint8_t> fixed) override {
    const std::vector<double> sizes = inverse_sizes(options_, fixed);
    if (engine_ && !sizes.empty()) {
      with_engine([&](auto& engine) { engine.set_sizes(order_, sizes); });
    }
  }

  SmoothingResult smooth(Point2<double>* stored, const LocalFrame* frame, Storage storage,
                         double fixed_quotient) override {
    return with_sliding_unless_given_up(
        [&](bool slides) { return smoothed(stored, frame, storage, fixed_quotient, slides); });
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// What comes behind the last sweep: the guard, and the writing to `stored`.
  struct Ending {
    GuardInput<T> input;
    Point2<double>* stored;
  };

  /// `slides`: unless nothing is to. Where that is given up the coordinates are as they were.
  SmoothingResult smoothed(Point2<double>* stored, const LocalFrame* frame, Storage storage, double fixed_quotient,
                           bool slides) {
    CallLimit::look();
    SmoothingResult result;
    result.backend = "cuda";
    result.device = device_;
    result.free_vertices = order_.free_count();
    result.colours = order_.colours;
    result.reproducible = options_.order == Order::colour;
    if (!engine_) {
      sweep_nothing(fixed_quotient, result);
      return result;
    }
    timeline_.rewind();
    timeline_.mark();
    slides_.begin(stored, frame, storage, slides);
    Ending ending{{order_.input_index.data(), before_.data(), {}, {}, &record_.data()->state, false, frame, storage},
                  stored};
    enter(ending, result);
    run(fixed_quotient, ending, result);
    finish(ending, result);
    result.timings.smooth = timeline_.milliseconds(0);
    result.timings.commit = timeline_.milliseconds(1);
    result.device_memory_bytes = static_cast<std::int64_t>(context_.peak_bytes());
    return result;
  }

  /// Calls body(engine) with the engine as it is.
  template <class Body>
  decltype(auto) with_engine(const Body& body) {
    return std::visit(body, *engine_);
  }

  LoopRules rules(double fixed_quotient) const {
    LoopRules rules{};
    rules.swaps = options_.form == Form::swap;
    rules.evaluates_all = options_.evaluation == Evaluation::all;
    rules.measures_shape = options_.measures_shape();
    rules.tolerance = options_.tolerance;
    rules.target = options_.target_quality.value_or(no_target);
    rules.fixed_quotient = fixed_quotient;
    rules.batch_count = static_cast<std::int32_t>(order_.batches.size()) - 1;
    rules.batches = order_.batch_begins.data();
    return rules;
  }

  /// A mesh without a free vertex: one sweep, in which nothing moves.
  void sweep_nothing(double fixed_quotient, SmoothingResult& result) const {
    const double shape = min_shape_of(std::numeric_limits<double>::infinity(), fixed_quotient);
    if (options_.target_quality && shape >= *options_.target_quality) {
      result.stop_reason = StopReason::quality_target;
      return;
    }
    SweepControl(options_, 0, result).add(SweepTally<T>{}, options_.measures_shape() ? shape : no_target, std::nullopt);
  }

  /// Queues the way to the working positions from those that are stored.
  void enter(const Ending& ending, SmoothingResult& result) {
    with_engine([&](auto& engine) {
      const auto [first, second] = engine.input();
      enter_frame_packed(context_, ending.stored, order_, ending.input.frame, before_.data(), first, second);
      engine.begin(ending.input.frame);
    });
    ++result.kernel_launches;
  }

  /// Sweeps to a stop and queues the ending. Where the engine may be followed it is queued without waiting for the
  /// sweeps: should they not have ended the run, it does nothing, and is queued again. Else it comes when the host
  /// knows of the end, as it does where the caller may have said stop before that.
  void run(double fixed_quotient, Ending& ending, SmoothingResult& result) {
    const auto seconds_since = [](Clock::time_point moment) {
      return std::chrono::duration<double>(Clock::now() - moment).count();
    };
    LoopRules loop = rules(fixed_quotient);
    LoopState& state = host_record_.state;
    state = LoopState{};
    SweepControl control(options_, order_.free_count(), result);
    const bool is_reached = options_.target_quality && min_shape_now(loop, result) >= *options_.target_quality;
    if (is_reached) {
      result.stop_reason = StopReason::quality_target;
    }
    if (is_reached || control.is_over()) {
      end_now(ending, result);
      return;
    }
    const bool may_follow =
        !options_.progress && with_engine([](const auto& engine) { return engine.may_be_followed; });
    const bool watched = options_.progress || options_.cancel;
    SweepBatches batches(RunRecord::most_sweeps, watched, options_.time_limit_seconds);
    for (bool is_over = false; !is_over;) {
      const auto launched = Clock::now();
      // What comes behind the last sweep is not queued behind a stage that is not the last.
      const bool follows = may_follow && !slides_.any() && control.stages().is_last();
      loop.remaining = control.sweeps_left();
      queue_sweeps(control, batches.size(), loop, result);
      ending.input.is_over = loop.sweeps == loop.remaining;
      if (follows) {
        queue_ending(ending, result);
      }
      finish_sweeps(control, result);
      const bool is_repeating = state.stop == LoopState::repeating;
      const std::int64_t last = result.sweeps + state.sweeps;
      // The clock is looked at behind the last sweep that was made; where all further ones are known, not at all.
      is_over = add_sweeps(control, loop, is_repeating ? std::nullopt : std::optional(control.seconds()));
      while (is_repeating && !is_over) {
        is_over = control.add_again();
      }
      if (!is_over) {
        batches.adapt(seconds_since(launched), control.seconds());
        continue;
      }
      // The last sweep that the caller was told of is not the last that was made, or `current` not where it left us.
      if (result.stop_reason == StopReason::cancelled && (is_repeating || result.sweeps != last)) {
        sweep_again(loop, ending, result);
      }
      if (!follows || !ran_to_its_end(result.stop_reason)) {
        end_now(ending, result);
      }
    }
  }

  /// The run once more up to the sweep at which the caller said stop: it gives the same bits again (but for
  /// Order::unordered), and costs less than to keep the positions of every sweep.
  void sweep_again(LoopRules loop, const Ending& ending, SmoothingResult& result) {
    slides_.restart();
    enter(ending, result);
    host_record_.state = LoopState{};
    loop.remaining = 0;
    SmoothingOptions unwatched = options_;
    unwatched.progress = nullptr;
    SmoothingResult again;
    SweepControl control(unwatched, order_.free_count(), again);
    while (again.sweeps < result.sweeps) {
      const auto left = std::min<std::int64_t>(result.sweeps - again.sweeps, RunRecord::most_sweeps);
      queue_sweeps(control, static_cast<std::int32_t>(left), loop, result);
      finish_sweeps(control, result);
      add_sweeps(control, loop, std::nullopt);
    }
  }

  /// Queues sweeps from where host_record_ says until the control is to be asked, `most` at most, and what slides
  /// behind them. What slides in this run is found while the device makes the first ones.
  void queue_sweeps(const SweepControl& control, std::int32_t most, LoopRules& loop, SmoothingResult& result) {
    if (control.begins_stage()) {
      host_record_.state.evaluates_all = 1;
      host_record_.state.marks = 0;
      with_engine([](auto& engine) { engine.begin_stage(); });
    }
    loop.sweeps = static_cast<std::int32_t>(control.sweeps_until_asked(most, slides_.any()));
    loop.few_moves = control.stages().few_moves();
    launch(control.stages().template step<T>(), loop, result);
    with_engine([&](auto& engine) {
      slides_.find_lines(engine, before_.data(), result);
      result.kernel_launches += slides_.queue(engine, control, loop.sweeps, record_.data(), context_.stream());
    });
  }

  /// Waits for them.
  void finish_sweeps(const SweepControl& control, SmoothingResult& result) {
    read_record(result);
    with_engine([&](auto& engine) { slides_.note(engine, control, host_record_.state); });
  }

  void launch(const MeanRatioStep<T>& step, LoopRules& loop, SmoothingResult& result) {
    loop.begins_with_all = host_record_.state.evaluates_all != 0;
    LoopState next = host_record_.state;
    next.sweeps = 0;
    next.stop = LoopState::running;
    next.children = 0;
    host_record_ = RunRecord{};
    host_record_.state = next;
    record_.upload({&host_record_, 1});
    result.kernel_launches += with_engine(
        [&](auto& engine) { return engine.sweep(step, loop, &record_.data()->state, record_.data()->sums.data()); });
  }

  /// Waits for the record of what has been queued.
  void read_record(SmoothingResult& result) {
    record_.download({&host_record_, 1});
    result.child_launches += static_cast<std::int64_t>(host_record_.state.children);
    if (const auto error = static_cast<cudaError_t>(host_record_.state.error); error != cudaSuccess) {
      throw DeviceError(std::string("CUDA: a kernel launch by the device failed: ") + cudaGetErrorName(error) + " (" +
                        cudaGetErrorString(error) + ")");
    }
  }

  void queue_ending(Ending& ending, SmoothingResult& result) {
    timeline_.rewind(1);
    timeline_.mark();
    result.kernel_launches += with_engine([&](auto& engine) {
      const auto [first, second] = engine.output(host_record_.state.current);
      ending.input.first = first;
      ending.input.second = second;
      return launch_guard(engine.rings(), ending.input, guard_buffers_, ending.stored, &record_.data()->guard,
                          context_.stream());
    });
    timeline_.mark();
  }

  /// The ending where the host knows that the run is over.
  void end_now(Ending& ending, SmoothingResult& result) {
    ending.input.is_over = true;
    if (slides_.any()) {
      end_slides(ending, result);
      return;
    }
    queue_ending(ending, result);
    record_.download({&host_record_, 1});
  }

  void end_slides(Ending& ending, SmoothingResult& result) {
    timeline_.rewind(1);
    timeline_.mark();
    with_engine([&](auto& engine) {
      const auto [first, second] = engine.output(host_record_.state.current);
      ending.input.first = first;
      ending.input.second = second;
      slides_.end(context_, engine, order_.free_count(), ending.input, guard_buffers_, ending.stored, record_,
                  host_record_, result);
    });
    timeline_.mark();
  }

  /// What is left of the ending when its record has been read.
  void finish(const Ending& ending, SmoothingResult& result) {
    if (slides_.any()) {
      context_.synchronize();
      return;
    }
    const std::int64_t queued = result.kernel_launches;
    DeviceGuardOutcome outcome = with_engine([&](const auto& engine) {
      return finish_guard(context_, engine.rings(), ending.input, guard_buffers_, ending.stored, &record_.data()->guard,
                          host_record_.guard, result.kernel_launches);
    });
    if (result.kernel_launches > queued) {
      timeline_.rewind(2);
      timeline_.mark();
    }
    result.guard_rounds = outcome.rounds;
    result.reverted_vertices = static_cast<std::int64_t>(outcome.reverted.size());
    result.reverted = std::move(outcome.reverted);
    result.moved_vertices = outcome.moved;
  }

  /// Tells the control of the sweeps of a launch, up to one that the run is over with: true then. `seconds`: since the
  /// run began, when the last one was made.
  bool add_sweeps(SweepControl& control, const LoopRules& loop, std::optional<double> seconds) const {
    const std::int32_t count = host_record_.state.sweeps;
    bool is_over = false;
    for (std::int32_t i = 0; i < count && !is_over; ++i) {
      const SweepSums& sums = host_record_.sums[static_cast<std::size_t>(i)];
      is_over = control.add(tally_of<T>(sums), loop.measures_shape ? min_shape_after(sums, loop) : no_target,
                            i + 1 == count ? seconds : std::nullopt);
    }
    return is_over;
  }

  double min_shape_now(const LoopRules& loop, SmoothingResult& result) {
    host_record_ = RunRecord{};
    record_.upload({&host_record_, 1});
    with_engine([&](const auto& engine) { engine.measure(record_.data()->sums.data()); });
    record_.download({&host_record_, 1});
    ++result.kernel_launches;
    return min_shape_after(host_record_.sums.front(), loop);
  }

  Context& context_;
  SmoothingOptions options_;
  std::string device_;
  VertexOrder order_;
  DeviceBuffer<Point2<double>> before_;
  GuardBuffers guard_buffers_;
  DeviceBuffer<RunRecord> record_;
  RunRecord host_record_{};
  SlidingRun<T> slides_{options_};
  Timeline timeline_;
  std::optional<SweepEngine<T>> engine_;  ///< none where there is no free vertex
};

}  // namespace

std::unique_ptr<DeviceSmoother> make_device_smoother(Context& context, DeviceRings rings,
                                                     DeviceBuffer<Point2<double>> points,
                                                     const SmoothingOptions& options) {
  PackedMesh mesh = pack(context, std::move(rings), std::move(points), options);
  if (options.precision == Precision::double_precision) {
    return std::make_unique<EngineSmoother<double>>(context, std::move(mesh), options);
  }
  return std::make_unique<EngineSmoother<float>>(context, std::move(mesh), options);
}

}  // namespace trismooth::cuda

#include "trismooth/cuda/device_smoother.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/run_record.h"
#include "trismooth/cuda/runtime/timeline.h"
#include "trismooth/cuda/sliding_run.h"
#include "trismooth/cuda/sweep_engine.h"
#include "trismooth/cuda/sweeps/device_stages.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_batches.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"

namespace trismooth::cuda {

namespace {

/// Drives an engine in working precision T from stored coordinates to stored coordinates.
template <class T>
class SweepDriver final : public DeviceSmoother {
 public:
  SweepDriver(Context& context, PackedMesh mesh, const SmoothingOptions& options)
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
    result.sweeps = 1;
    result.history.push_back({1, 0, 0, 0, options_.measures_shape() ? shape : no_target});
    if (options_.progress) {
      options_.progress(result.history.back());
    }
  }

  /// Queues the way to the working positions from those that are stored.
  void enter(const Ending& ending, SmoothingResult& result) {
    with_engine([&](auto& engine) {
      const auto [first, second] = engine.input();
      enter_frame_packed(context_, ending.stored, order_, ending.input.frame, before_.data(), first, second);
      engine.begin();
    });
    ++result.kernel_launches;
  }

  /// Sweeps to a stop and queues the ending. Where the engine may be followed it is queued without waiting for the
  /// sweeps: should they not have ended the run, it does nothing, and is queued again. Else it comes when the host
  /// knows of the end, as it does where the caller may have said stop before that.
  void run(double fixed_quotient, Ending& ending, SmoothingResult& result) {
    const auto start = Clock::now();
    const auto seconds_since = [](Clock::time_point moment) {
      return std::chrono::duration<double>(Clock::now() - moment).count();
    };
    LoopRules loop = rules(fixed_quotient);
    LoopState& state = host_record_.state;
    state = LoopState{};
    if (options_.target_quality && min_shape_now(loop, result) >= *options_.target_quality) {
      result.stop_reason = StopReason::quality_target;
      end_now(ending, result);
      return;
    }
    const bool may_follow =
        !options_.progress && with_engine([](const auto& engine) { return engine.may_be_followed; });
    const bool watched = static_cast<bool>(options_.progress);
    SweepBatches batches(RunRecord::most_sweeps, watched, options_.time_limit_seconds);
    DeviceStages stages(options_, order_.free_count());
    begin_stage();
    for (;;) {
      const auto launched = Clock::now();
      // What comes behind the last sweep is not queued behind a stage that is not the last.
      const bool follows = may_follow && !slides_.any() && stages.is_last();
      loop.sweeps = slides_.up_to_slide(stages.at_most(batches.size()));
      if (options_.max_sweeps > 0) {
        loop.remaining = options_.max_sweeps - result.sweeps;
        loop.sweeps = static_cast<std::int32_t>(std::min<std::int64_t>(loop.sweeps, loop.remaining));
        ending.input.is_over = loop.sweeps == loop.remaining;
      }
      launch(stages, loop, result);
      if (follows) {
        queue_ending(ending, result);
      }
      queue_slides(stages, loop, result.sweeps, result);
      read_record(result);
      note_slides(stages, loop, result.sweeps);
      bool stopped = read_sweeps(loop, result);
      const bool is_repeating = state.stop == LoopState::repeating;
      if (is_repeating && !stopped) {
        stopped = repeat_last_two(result);
      }
      // The last sweep that the caller was told of is not the last that was made, or `current` not where it left us.
      const bool overran = stopped && (is_repeating || result.sweeps != sweeps_before_ + state.sweeps);
      if (overran) {
        sweep_again(loop, ending, result);
        result.stop_reason = StopReason::cancelled;
      } else if (is_repeating) {
        result.stop_reason = StopReason::sweep_limit;
      } else if (const auto reason = reason_of(state, stages, result)) {
        result.stop_reason = *reason;
      } else if (stopped) {
        result.stop_reason = StopReason::cancelled;
      } else if (result.sweeps == options_.max_sweeps) {
        result.stop_reason = StopReason::sweep_limit;
      } else if (seconds_since(start) >= options_.time_limit_seconds) {
        result.stop_reason = StopReason::time_limit;
      } else {
        batches.adapt(seconds_since(launched), seconds_since(start));
        const bool settled = state.stop != LoopState::running;
        if (stages.is_over(state.sweeps, settled)) {
          stages.next(result.history.back().moved, settled);
          begin_stage();
        }
        continue;
      }
      if (!follows || result.stop_reason == StopReason::time_limit) {
        end_now(ending, result);
      }
      return;
    }
  }

  /// The run once more up to the sweep at which the caller said stop: it gives the same bits again (but for
  /// Order::unordered), and costs less than to keep the positions of every sweep.
  void sweep_again(LoopRules loop, const Ending& ending, SmoothingResult& result) {
    slides_.restart();
    enter(ending, result);
    host_record_.state = LoopState{};
    loop.remaining = 0;
    DeviceStages stages(options_, order_.free_count());
    begin_stage();
    for (std::int64_t done = 0; done < result.sweeps;) {
      const auto left = std::min<std::int64_t>(result.sweeps - done, RunRecord::most_sweeps);
      loop.sweeps = slides_.up_to_slide(stages.at_most(static_cast<std::int32_t>(left)));
      launch(stages, loop, result);
      queue_slides(stages, loop, done, result);
      read_record(result);
      note_slides(stages, loop, done);
      done += host_record_.state.sweeps;
      const bool settled = host_record_.state.stop != LoopState::running;
      if (stages.is_over(host_record_.state.sweeps, settled)) {
        stages.next(result.history[static_cast<std::size_t>(done) - 1].moved, settled);
        begin_stage();
      }
    }
  }

  /// Makes ready for a stage from where host_record_ says.
  void begin_stage() {
    host_record_.state.evaluates_all = 1;
    host_record_.state.marks = 0;
    slides_.begin_stage();
    with_engine([](auto& engine) { engine.begin_stage(); });
  }

  /// Queues the slides behind the sweeps of a launch. `done`: sweeps of the run before it. What slides is found while
  /// the device makes the first ones.
  void queue_slides(const DeviceStages& stages, const LoopRules& loop, std::int64_t done, SmoothingResult& result) {
    with_engine([&](auto& engine) {
      slides_.find_lines(engine, before_.data(), result);
      result.kernel_launches += slides_.queue(engine, stages, loop, done, record_.data(), context_.stream());
    });
  }

  void note_slides(const DeviceStages& stages, const LoopRules& loop, std::int64_t done) {
    with_engine([&](auto& engine) { slides_.note(engine, stages, loop, done, host_record_); });
  }

  /// Why the smoothing ends with the last sweep of a launch, as far as its kernels know.
  std::optional<StopReason> reason_of(const LoopState& state, const DeviceStages& stages,
                                      const SmoothingResult& result) const {
    if (state.stop == LoopState::running) {
      return std::nullopt;
    }
    const auto reason = static_cast<StopReason>(state.stop);
    if (stages.is_last() || reason == StopReason::quality_target) {
      return reason;
    }
    // It ends the stage; what else the sweep may have brought about counts still.
    const bool reached = result.history.back().min_shape >= options_.target_quality.value_or(no_target);
    return reached ? std::optional(StopReason::quality_target) : std::nullopt;
  }

  /// Queues more sweeps from where host_record_ says.
  void launch(const DeviceStages& stages, LoopRules loop, SmoothingResult& result) {
    loop.few_moves = stages.few_moves();
    loop.begins_with_all = host_record_.state.evaluates_all != 0;
    LoopState next = host_record_.state;
    next.sweeps = 0;
    next.stop = LoopState::running;
    next.children = 0;
    host_record_ = RunRecord{};
    host_record_.state = next;
    record_.upload({&host_record_, 1});
    result.kernel_launches += with_engine([&](auto& engine) {
      return engine.sweep(stages.step<T>(), loop, &record_.data()->state, record_.data()->sums.data());
    });
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

  /// Writes the sweeps of a launch into the history, up to one at which the caller's callback says stop: true then.
  bool read_sweeps(const LoopRules& loop, SmoothingResult& result) {
    sweeps_before_ = result.sweeps;
    for (std::int32_t i = 0; i < host_record_.state.sweeps; ++i) {
      const SweepSums& sums = host_record_.sums[static_cast<std::size_t>(i)];
      const auto largest = static_cast<T>(std::bit_cast<double>(sums.max_relative));
      SweepRecord record{result.sweeps + 1, static_cast<std::int64_t>(sums.evaluated),
                         static_cast<std::int64_t>(sums.moved), static_cast<double>(std::sqrt(largest))};
      if (loop.measures_shape) {
        record.min_shape = min_shape_after(sums, loop);
      }
      if (add(record, result)) {
        return true;
      }
    }
    return false;
  }

  /// The sweeps that are left until the limit: each is the one two before it once more. True where the caller's
  /// callback said stop.
  bool repeat_last_two(SmoothingResult& result) const {
    while (result.sweeps < options_.max_sweeps) {
      SweepRecord record = result.history[result.history.size() - 2];
      record.sweep = result.sweeps + 1;
      if (add(record, result)) {
        return true;
      }
    }
    return false;
  }

  /// One more sweep for the history. True where the caller's callback said stop.
  bool add(const SweepRecord& record, SmoothingResult& result) const {
    result.sweeps = record.sweep;
    result.vertex_updates += record.evaluated;
    result.history.push_back(record);
    return options_.progress && options_.progress(record) == Progress::stop;
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
  std::int64_t sweeps_before_ = 0;  ///< of the run, when the last launch began
  Timeline timeline_;
  std::optional<SweepEngine<T>> engine_;  ///< none where there is no free vertex
};

}  // namespace

std::unique_ptr<DeviceSmoother> make_device_smoother(Context& context, DeviceRings rings,
                                                     DeviceBuffer<Point2<double>> points,
                                                     const SmoothingOptions& options) {
  PackedMesh mesh = pack(context, std::move(rings), std::move(points), options);
  if (options.precision == Precision::double_precision) {
    return std::make_unique<SweepDriver<double>>(context, std::move(mesh), options);
  }
  return std::make_unique<SweepDriver<float>>(context, std::move(mesh), options);
}

}  // namespace trismooth::cuda

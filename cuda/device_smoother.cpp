#include "trismooth/cuda/device_smoother.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/guard/commit.h"
#include "trismooth/cuda/runtime/timeline.h"
#include "trismooth/cuda/sweeps/sweep_batches.h"
#include "trismooth/cuda/sweeps/sweep_engine.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

namespace {

/// What a launch of sweeps and the commit behind it leave for the host, in one piece: one copy brings it over.
struct RunRecord {
  static constexpr std::int32_t most_sweeps = 256;

  LoopState state;
  CommitState commit;
  std::array<SweepSums, most_sweeps> sums;
};

template <class T, Layout layout>
class TypedSmoother final : public DeviceSmoother {
 public:
  TypedSmoother(Context& context, PackedDeviceRings rings, const SmoothingOptions& options)
      : context_(context),
        options_(options),
        device_(require_device()),
        rings_(std::move(rings)),
        before_(context, static_cast<std::size_t>(rings_.vertex_count())),
        record_(context, 1),
        timeline_(context) {
    if (rings_.free_count() > 0) {
      engine_ = make_sweep_engine<T, layout>(context, rings_, options);
      if (options.guard) {
        commit_buffers_ = CommitBuffers(context, rings_.free_count());
      }
    }
  }

  SmoothingResult smooth(Point2<double>* stored, const LocalFrame* frame, Storage storage,
                         double fixed_quotient) override {
    SmoothingResult result;
    result.backend = "cuda";
    result.device = device_;
    result.free_vertices = rings_.free_count();
    result.colours = rings_.colours;
    result.reproducible = options_.order == Order::colour;
    if (engine_ == nullptr) {
      sweep_nothing(fixed_quotient, result);
      return result;
    }
    timeline_.rewind();
    timeline_.mark();
    Commit commit{{&rings_, before_.data(), {}, {}, &record_.data()->state, false, frame, storage}, stored};
    enter(commit, result);
    run(fixed_quotient, commit, result);
    end(commit, result);
    result.timings.smooth = timeline_.milliseconds(0);
    result.timings.commit = timeline_.milliseconds(1);
    result.device_memory_bytes = static_cast<std::int64_t>(context_.peak_bytes());
    return result;
  }

 private:
  using Clock = std::chrono::steady_clock;

  struct Commit {
    CommitInput<T, layout> input;
    Point2<double>* stored;
  };

  bool measures_shape() const { return options_.record_min_shape || options_.target_quality.has_value(); }

  LoopRules rules(double fixed_quotient) const {
    LoopRules rules{};
    rules.swaps = options_.form == Form::swap;
    rules.evaluates_all = options_.evaluation == Evaluation::all;
    rules.measures_shape = measures_shape();
    rules.tolerance = options_.tolerance;
    rules.target = options_.target_quality.value_or(no_target);
    rules.fixed_quotient = fixed_quotient;
    rules.batch_count = static_cast<std::int32_t>(rings_.batches.size()) - 1;
    rules.batches = rings_.batch_begins.data();
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
    result.history.push_back({1, 0, 0, 0, measures_shape() ? shape : no_target});
    if (options_.progress) {
      options_.progress(result.history.back());
    }
  }

  /// Queues the way to the working positions from those that are stored.
  void enter(const Commit& commit, SmoothingResult& result) {
    const auto [first, second] = engine_->input();
    launch_enter(commit.stored, rings_.input_index.data(), rings_.vertex_count(), commit.input.frame, before_.data(),
                 first, second, context_.stream());
    engine_->begin();
    ++result.kernel_launches;
  }

  /// Sweeps to a stop and queues the commit. Behind resident sweeps it is queued without waiting for them: should they
  /// not have ended the run, it does nothing, and is queued again. Else the commit comes when the host knows of the
  /// end, as it does where the caller may have said stop before that.
  void run(double fixed_quotient, Commit& commit, SmoothingResult& result) {
    const auto start = Clock::now();
    const auto seconds_since = [](Clock::time_point moment) {
      return std::chrono::duration<double>(Clock::now() - moment).count();
    };
    LoopRules loop = rules(fixed_quotient);
    LoopState& state = host_record_.state;
    state = LoopState{};
    if (options_.target_quality && min_shape_now(loop, result) >= *options_.target_quality) {
      result.stop_reason = StopReason::quality_target;
      commit_now(commit, result);
      return;
    }
    const bool commits_behind = options_.execution == Execution::resident && !options_.progress;
    const bool watched = static_cast<bool>(options_.progress);
    SweepBatches batches(RunRecord::most_sweeps, watched, options_.time_limit_seconds);
    for (;;) {
      const auto launched = Clock::now();
      loop.sweeps = batches.size();
      if (options_.max_sweeps > 0) {
        loop.remaining = options_.max_sweeps - result.sweeps;
        loop.sweeps = static_cast<std::int32_t>(std::min<std::int64_t>(loop.sweeps, loop.remaining));
        commit.input.is_over = loop.sweeps == loop.remaining;
      }
      launch(loop, result);
      if (commits_behind) {
        queue_commit(commit, result);
      }
      read_record(result);
      bool stopped = read_sweeps(loop, result);
      const bool is_repeating = state.stop == LoopState::repeating;
      if (is_repeating && !stopped) {
        stopped = repeat_last_two(result);
      }
      // The last sweep that the caller was told of is not the last that was made, or `current` not where it left us.
      const bool overran = stopped && (is_repeating || result.sweeps != sweeps_before_ + state.sweeps);
      if (overran) {
        sweep_again(loop, commit, result);
        result.stop_reason = StopReason::cancelled;
      } else if (is_repeating) {
        result.stop_reason = StopReason::sweep_limit;
      } else if (state.stop != LoopState::running) {
        result.stop_reason = static_cast<StopReason>(state.stop);
      } else if (stopped) {
        result.stop_reason = StopReason::cancelled;
      } else if (result.sweeps == options_.max_sweeps) {
        result.stop_reason = StopReason::sweep_limit;
      } else if (seconds_since(start) >= options_.time_limit_seconds) {
        result.stop_reason = StopReason::time_limit;
      } else {
        batches.adapt(seconds_since(launched), seconds_since(start));
        continue;
      }
      if (!commits_behind || result.stop_reason == StopReason::time_limit) {
        commit_now(commit, result);
      }
      return;
    }
  }

  /// The run once more up to the sweep at which the caller said stop: it gives the same bits again (but for
  /// Order::unordered), and costs less than to keep the positions of every sweep.
  void sweep_again(LoopRules loop, const Commit& commit, SmoothingResult& result) {
    enter(commit, result);
    host_record_.state = LoopState{};
    loop.remaining = 0;
    for (std::int64_t left = result.sweeps; left > 0; left -= host_record_.state.sweeps) {
      loop.sweeps = static_cast<std::int32_t>(std::min<std::int64_t>(left, RunRecord::most_sweeps));
      launch(loop, result);
      read_record(result);
    }
  }

  /// Queues more sweeps from where host_record_ says.
  void launch(const LoopRules& loop, SmoothingResult& result) {
    LoopState next = host_record_.state;
    next.sweeps = 0;
    next.stop = LoopState::running;
    next.children = 0;
    host_record_ = RunRecord{};
    host_record_.state = next;
    record_.upload({&host_record_, 1});
    result.kernel_launches += engine_->sweep(loop, &record_.data()->state, record_.data()->sums.data());
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

  void queue_commit(Commit& commit, SmoothingResult& result) {
    timeline_.rewind(1);
    timeline_.mark();
    if (options_.execution == Execution::resident) {
      commit.input.first = engine_->output(0);
      commit.input.second = engine_->output(1);
    } else {
      commit.input.first = commit.input.second = engine_->output(host_record_.state.current);
    }
    result.kernel_launches +=
        launch_commit(commit.input, commit_buffers_, commit.stored, &record_.data()->commit, context_.stream());
    timeline_.mark();
  }

  /// Commits where the host knows that the run is over.
  void commit_now(Commit& commit, SmoothingResult& result) {
    commit.input.is_over = true;
    queue_commit(commit, result);
    record_.download({&host_record_, 1});
  }

  /// What is left of the commit when its record has been read.
  void end(const Commit& commit, SmoothingResult& result) {
    const std::int64_t queued = result.kernel_launches;
    CommitOutcome outcome = finish_commit(context_, commit.input, commit_buffers_, commit.stored,
                                          &record_.data()->commit, host_record_.commit, result.kernel_launches);
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
    engine_->measure(record_.data()->sums.data());
    record_.download({&host_record_, 1});
    ++result.kernel_launches;
    return min_shape_after(host_record_.sums.front(), loop);
  }

  Context& context_;
  SmoothingOptions options_;
  std::string device_;
  PackedDeviceRings rings_;
  DeviceBuffer<Point2<double>> before_;
  CommitBuffers commit_buffers_;
  DeviceBuffer<RunRecord> record_;
  RunRecord host_record_{};
  std::int64_t sweeps_before_ = 0;  ///< of the run, when the last launch began
  Timeline timeline_;
  std::unique_ptr<SweepEngine<T, layout>> engine_;
};

template <class T>
std::unique_ptr<DeviceSmoother> make_in_layout(Context& context, PackedDeviceRings rings,
                                               const SmoothingOptions& options) {
  if (options.layout == Layout::aos) {
    return std::make_unique<TypedSmoother<T, Layout::aos>>(context, std::move(rings), options);
  }
  return std::make_unique<TypedSmoother<T, Layout::soa>>(context, std::move(rings), options);
}

}  // namespace

std::unique_ptr<DeviceSmoother> make_device_smoother(Context& context, PackedDeviceRings rings,
                                                     const SmoothingOptions& options) {
  if (options.precision == Precision::double_precision) {
    return make_in_layout<double>(context, std::move(rings), options);
  }
  return make_in_layout<float>(context, std::move(rings), options);
}

}  // namespace trismooth::cuda

#include "trismooth/cuda/device_smoother.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "trismooth/cuda/bounding_box.h"
#include "trismooth/cuda/commit.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/sweep_engine.h"
#include "trismooth/cuda/timeline.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

namespace {

/// What a launch leaves for the host, in one piece: one copy brings it over.
struct RunRecord {
  static constexpr std::int32_t most_sweeps = 256;

  LoopState state;
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
        record_(context, 1) {
    if (rings_.free_count() > 0) {
      engine_ = make_sweep_engine<T, layout>(context, rings_, options);
    }
  }

  SmoothingResult smooth(Point2<double>* stored, Storage storage, double fixed_quotient) override {
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
    Timeline timeline(context_);
    timeline.mark();
    const auto [low, high] = bounding_box(context_, stored, rings_.vertex_count());
    const LocalFrame frame = local_frame(low, high);
    const auto [first, second] = engine_->input();
    launch_enter(stored, rings_.input_index.data(), rings_.vertex_count(), frame, before_.data(), first, second,
                 context_.stream());
    engine_->begin();
    result.kernel_launches += 2;
    const std::int32_t current = run(fixed_quotient, result);
    timeline.mark();
    const CommitView<T, layout> view{
        rings_.rings.view(), rings_.input_index.data(), before_.data(), engine_->output(current), frame, storage};
    CommitOutcome outcome = commit(context_, view, options_.guard, stored);
    timeline.mark();
    result.guard_rounds = outcome.rounds;
    result.reverted_vertices = static_cast<std::int64_t>(outcome.reverted.size());
    result.reverted = std::move(outcome.reverted);
    result.moved_vertices = outcome.moved;
    result.kernel_launches += outcome.launches;
    result.timings.smooth = timeline.milliseconds(0);
    result.timings.commit = timeline.milliseconds(1);
    result.device_memory_bytes = static_cast<std::int64_t>(context_.peak_bytes());
    return result;
  }

 private:
  using Clock = std::chrono::steady_clock;

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

  /// Sweeps to a stop; the buffer that holds the positions. The host looks in after every sweep if it has a callback or
  /// a clock to ask, else when the records of a launch are full.
  std::int32_t run(double fixed_quotient, SmoothingResult& result) {
    const auto start = Clock::now();
    LoopRules loop = rules(fixed_quotient);
    auto& [state, sums] = host_record_;
    state = LoopState{};
    if (options_.target_quality && min_shape_now(loop, result) >= *options_.target_quality) {
      result.stop_reason = StopReason::quality_target;
      return 0;
    }
    const bool host_decides =
        options_.progress || options_.time_limit_seconds < std::numeric_limits<double>::infinity();
    for (;;) {
      loop.sweeps = host_decides ? 1 : RunRecord::most_sweeps;
      if (options_.max_sweeps > 0) {
        loop.sweeps =
            static_cast<std::int32_t>(std::min<std::int64_t>(loop.sweeps, options_.max_sweeps - result.sweeps));
      }
      launch(loop, result);
      const bool stopped = read_sweeps(loop, result);
      if (state.stop != LoopState::running) {
        result.stop_reason = static_cast<StopReason>(state.stop);
      } else if (stopped) {
        result.stop_reason = StopReason::cancelled;
      } else if (result.sweeps == options_.max_sweeps) {
        result.stop_reason = StopReason::sweep_limit;
      } else if (std::chrono::duration<double>(Clock::now() - start).count() >= options_.time_limit_seconds) {
        result.stop_reason = StopReason::time_limit;
      } else {
        continue;
      }
      return state.current;
    }
  }

  /// Sweeps once more from where host_record_ says, and brings the record back.
  void launch(const LoopRules& loop, SmoothingResult& result) {
    LoopState next;
    next.current = host_record_.state.current;
    host_record_ = RunRecord{};
    host_record_.state = next;
    record_.upload({&host_record_, 1});
    engine_->sweep(loop, &record_.data()->state, record_.data()->sums.data());
    record_.download({&host_record_, 1});
    ++result.kernel_launches;
    result.child_launches += static_cast<std::int64_t>(host_record_.state.children);
    if (const auto error = static_cast<cudaError_t>(host_record_.state.error); error != cudaSuccess) {
      throw DeviceError(std::string("CUDA: a kernel launch by the device failed: ") + cudaGetErrorName(error) + " (" +
                        cudaGetErrorString(error) + ")");
    }
  }

  /// Writes the sweeps of a launch into the history. True where the caller's callback said stop.
  bool read_sweeps(const LoopRules& loop, SmoothingResult& result) const {
    bool stopped = false;
    for (std::int32_t i = 0; i < host_record_.state.sweeps; ++i) {
      const SweepSums& sums = host_record_.sums[static_cast<std::size_t>(i)];
      const auto largest = static_cast<T>(std::bit_cast<double>(sums.max_relative));
      SweepRecord record{++result.sweeps, static_cast<std::int64_t>(sums.evaluated),
                         static_cast<std::int64_t>(sums.moved), static_cast<double>(std::sqrt(largest))};
      if (loop.measures_shape) {
        record.min_shape = min_shape_after(sums, loop);
      }
      result.vertex_updates += record.evaluated;
      result.history.push_back(record);
      stopped = options_.progress && options_.progress(record) == Progress::stop;
    }
    return stopped;
  }

  double min_shape_now(const LoopRules& loop, SmoothingResult& result) {
    host_record_ = RunRecord{};
    record_.upload({&host_record_, 1});
    launch_min_quotient(rings_.rings.view(), engine_->input().first, record_.data()->sums.data(), context_.stream());
    record_.download({&host_record_, 1});
    ++result.kernel_launches;
    return min_shape_after(host_record_.sums.front(), loop);
  }

  Context& context_;
  SmoothingOptions options_;
  std::string device_;
  PackedDeviceRings rings_;
  DeviceBuffer<Point2<double>> before_;
  DeviceBuffer<RunRecord> record_;
  RunRecord host_record_{};
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

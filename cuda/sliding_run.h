// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/run_record.h"
#include "trismooth/cuda/slide/device_slide.h"
#include "trismooth/cuda/slide/slide_pass.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/sweeps/sweep_control.h"

namespace trismooth::cuda {

/// What slides among the sweeps of a run in working precision T, and what comes of it at the end. `Engine`: one of
/// SweepEngine<T>.
template <class T>
class SlidingRun {
 public:
  /// `options` outlive it.
  explicit SlidingRun(const SmoothingOptions& options) : options_(options) {}

  /// Has these slide from the next run on: see DeviceSlide.
  void allow(Context& context, const VertexOrder& order, Slidable slidable, std::vector<std::uint8_t> reversed) {
    slide_.emplace(context, order, std::move(slidable), std::move(reversed));
  }

  /// Begins a run with vertices as they are stored; `slides`: unless nothing is to. Waits for the device where
  /// something may slide.
  void begin(const Point2<double>* stored, const LocalFrame* frame, Storage storage, bool slides) {
    slides_ = slides && slide_.has_value();
    if (slides_) {
      slide_->begin(stored, frame, storage);
    }
  }
  /// Whether something slides in this run, or may as far as is known.
  bool any() const { return slides_; }
  /// All sliders go back to where they began: the run is made once more.
  void restart() {
    if (slides_) {
      slide_->restart();
    }
  }

  /// Finds what slides, and says it in the result, unless that has been done in this run: while the first sweeps are
  /// made. `before`: as GuardInput.
  template <class Engine>
  void find_lines(const Engine& engine, const Point2<double>* before, SmoothingResult& result) {
    if (!slides_ || slide_->has_lines()) {
      return;
    }
    slides_ = slide_->find_lines();
    result.sliding = slide_->lines();
    if (slides_ && options_.method == Method::mean_ratio) {
      slide_->aim(engine.targets(), before);
    }
  }

  /// Queues the slides behind sweeps of that number that have been queued. Returns the number of launches.
  template <class Engine>
  std::int64_t queue(Engine& engine, const SweepControl& control, std::int32_t sweeps, RunRecord* record,
                     cudaStream_t stream) {
    if (!slides_) {
      return 0;
    }
    const auto [first, second] = engine.output(0);
    SlideWork<T> work = slide_->template work<T>();
    work.first = first;
    work.second = second;
    work.first_marks = engine.marks(0);
    work.second_marks = engine.marks(1);
    work.tolerance = static_cast<T>(options_.tolerance);
    const bool due_at_end = control.slides_behind(sweeps, false);
    return launch_slide_pass(
        MethodInUse<T>{options_.method, engine.targets().view(), control.stages().template step<T>()}, work,
        slide_->batches(), due_at_end ? sweeps : 0, &record->state, record->sums.data(), stream);
  }

  /// Has the engine know where vertices slid behind the last sweep of a record, which the control has not been told of:
  /// what they did is in its sums, and whether it settled is for these to say.
  template <class Engine>
  void note(Engine& engine, const SweepControl& control, LoopState& state) {
    if (slides_ && state.sweeps > 0 && control.slides_behind(state.sweeps, state.stop != LoopState::running)) {
      engine.note_slides(state);
      state.stop = LoopState::running;
    }
  }

  /// The ending of the run. Lines and elements have their say in turn; when nobody has anything to say, all is written
  /// to `stored`. Mostly nobody has: so the device judges both at first, and the host sees to lines where the device
  /// finds something. Where that gives sliding up, as the result says, nothing is written. `free_count`: of vertices;
  /// `host_record`: what `record`, on the device, was read as. Waits for the device.
  template <class Engine>
  void end(Context& context, Engine& engine, std::int64_t free_count, GuardInput<T> input, GuardBuffers& buffers,
           Point2<double>* stored, DeviceBuffer<RunRecord>& record, RunRecord& host_record, SmoothingResult& result) {
    const auto rings = engine.rings();
    GuardState* const state = &record.data()->guard;
    LineVerdict* const lines = &record.data()->lines;
    const auto list = [&](std::int32_t vertex, Point2<double> position) {
      result.reverted.push_back({vertex, position});
    };
    const auto reset = [&] {
      host_record.guard = {};
      record.upload({&host_record, 1});
    };
    const auto guard = [&] {
      result.kernel_launches += launch_guard(rings, input, buffers, stored, state, context.stream());
    };
    input.held = slide_->held();
    input.held.lines = lines;
    host_record.lines = {};
    reset();
    slide_->judge(input.before, options_.guard, lines);
    guard();
    slide_->queue_writing(input.before, stored, state, lines);
    record.download({&host_record, 1});
    const LineVerdict verdict = host_record.lines;
    if (!verdict.is_good(host_record.guard.all.before) || !host_record.guard.nothing_offends()) {
      input.held.lines = nullptr;
      // What is queued already is the first say that elements have.
      bool is_guarded = verdict.has_good_lines();
      const auto settle_lines = [&] { return is_guarded ? std::int64_t{0} : slide_->settle(input.before, list); };
      const auto guard_elements = [&] {
        if (!std::exchange(is_guarded, false)) {
          reset();
          guard();
          record.download({&host_record, 1});
        }
        const DeviceGuardOutcome outcome =
            finish_guard(context, rings, input, buffers, stored, state, host_record.guard, result.kernel_launches);
        result.reverted.insert(result.reverted.end(), outcome.reverted.begin(), outcome.reverted.end());
        slide_->note_reverted(outcome.held, list);
        return ElementRounds{outcome.rounds, outcome.threshold, !outcome.held.empty()};
      };
      result.guard_rounds += settle_in_turn(options_.guard, settle_lines, guard_elements, [&](double threshold) {
        return slide_->settle_held_elements(input.before, threshold, list);
      });
      SlidingResult sliding = slide_->lines();
      if (ran_to_its_end(result.stop_reason) &&
          is_spoilt_by_sliding(std::ssize(result.reverted), free_count + sliding.vertices)) {
        sliding.given_up = true;
        result.sliding = sliding;
        return;
      }
      launch_writing(rings, input, stored, state, context.stream());
      slide_->queue_writing(input.before, stored, nullptr, nullptr);
      record.download({&host_record, 1});
    }
    result.moved_vertices = host_record.guard.moved;
    slide_->report(verdict, result);
    // (Nobody goes back twice.)
    std::ranges::sort(result.reverted, {}, &RevertedVertex::vertex);
    result.reverted_vertices = std::ssize(result.reverted);
  }

 private:
  const SmoothingOptions& options_;
  std::optional<DeviceSlide> slide_;  ///< what may slide
  bool slides_ = false;
};

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/storage.h"
#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/slide/device_chains.h"
#include "trismooth/cuda/slide/slid_points.h"
#include "trismooth/cuda/slide/slide_pass.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/slide/packed_slidable.h"
#include "trismooth/smoothing/slide/slid_vertices.h"
#include "trismooth/smoothing/slide/slide_guard.h"

namespace trismooth::cuda {

/// What slides in a mesh on the device. Lines are found and judged by the host, which has few vertices to look at for
/// that; vertices slide on the device, among the sweeps.
class DeviceSlide {
 public:
  /// `order` outlives it. `reversed`: as MeshRings::reversed, of the Slidable's elements. Waits for the device.
  DeviceSlide(Context& context, const VertexOrder& order, Slidable slidable, std::vector<std::uint8_t> reversed);

  /// Brings the vertices over for a run, as they are stored, and has a thread find the lines. `stored`, `frame`: on the
  /// device. Waits for it.
  void begin(const Point2<double>* stored, const LocalFrame* frame, Storage storage);
  bool has_lines() const { return has_lines_; }
  /// Waits for the lines of the run and brings them to the device. False: nothing slides. It takes as long as a few
  /// sweeps till they are found: so this comes behind the queuing of those that no vertex slides before.
  bool find_lines();
  /// Puts all vertices at their own knots: the run begins once more.
  void restart() { device_.begin(local_); }

  /// What launch_slide_pass() takes, but for positions, marks and tolerance.
  template <class T>
  SlideWork<T> work() const {
    SlideWork<T> found{};
    found.view = device_.view();
    found.places = device_.places();
    found.targets = has_targets_ ? targets_.data() : nullptr;
    found.free_count = order_->free_count();
    return found;
  }
  std::span<const std::int32_t> batches() const { return local_.batches; }

  /// Queues the finding of what the mean-ratio method aims at. `before`: as GuardInput.
  template <class T>
  void aim(const DeviceTargets<T>& targets, const Point2<double>* before);

  /// Queues the finding of where everybody is to be stored, and what is to be said of that. `before`: as GuardInput.
  /// `guards`: elements count, too.
  void judge(const Point2<double>* before, bool guards, LineVerdict* verdict);
  /// Puts back what the lines do not allow, on the host, for the guard to look at. Calls reverted(vertex, position)
  /// with the caller's number of each vertex that goes back, and where it would have been stored. Returns the rounds.
  /// `before`: as GuardInput.
  template <class Reverted>
  std::int64_t settle(const Point2<double>* before, const Reverted& reverted) {
    is_judged_by_host_ = true;
    return put_back(before, reverted, [](SlideGuard& guard, auto& back) { return guard.settle(back); });
  }
  /// settle() of elements without a free vertex: see SlideGuard::settle_held_elements().
  template <class Reverted>
  std::int64_t settle_held_elements(const Point2<double>* before, double threshold_of_others,
                                    const Reverted& reverted) {
    if (local_.held_elements().empty()) {
      return 0;
    }
    return put_back(before, reverted, [threshold_of_others](SlideGuard& guard, auto& back) {
      return guard.settle_held_elements(threshold_of_others, back);
    });
  }
  /// What the guard on the device has to know.
  HeldView held() { return {held_after_.data(), fan_of_.data(), device_.view().fans, device_.view().sides, nullptr}; }
  /// Notes what that has put back: packed numbers. Other arguments as those of settle().
  template <class Reverted>
  void note_reverted(std::span<const std::int32_t> held, const Reverted& reverted) {
    if (held.empty()) {
      return;
    }
    take_over();
    std::vector<std::int32_t> back;
    for (const std::int32_t v : held) {
      back.push_back(put_back(v));
    }
    tell(back, reverted);
  }
  /// Queues the writing of those that are elsewhere: see write_slid().
  void queue_writing(const Point2<double>* before, Point2<double>* stored, const GuardState* state,
                     const LineVerdict* verdict) {
    write_slid(*context_, slid_points(), before, order_->input_index.data(), stored, state, verdict);
  }
  /// What is to be said of the lines before anybody has slid.
  SlidingResult lines() const { return local_.result(); }
  /// Adds them to the result, and says what became of all. `verdict`: of judge(), which counts unless somebody has gone
  /// back since.
  void report(const LineVerdict& verdict, SmoothingResult& result) const;

 private:
  /// Has the host know where everybody is, unless it does already. Waits for the device.
  void take_over();
  template <class Reverted, class Settle>
  std::int64_t put_back(const Point2<double>* before, const Reverted& reverted, const Settle& settle) {
    take_over();
    std::vector<std::int32_t> back;
    const std::int64_t rounds = settle(*guard_, back);
    tell(back, reverted);
    if (rounds > 0) {
      place_again(before);
    }
    return rounds;
  }
  void place_again(const Point2<double>* before);
  SlidPoints slid_points();
  /// The number in the Slidable of the vertex with that packed number, which goes back.
  std::int32_t put_back(std::int32_t packed);
  template <class Reverted>
  void tell(std::span<const std::int32_t> back, const Reverted& reverted) {
    for (const std::int32_t v : back) {
      reverted(slidable_.slidable().vertices[static_cast<std::size_t>(v)], slid_.find(v)->stored);
    }
  }

  Context* context_;
  const VertexOrder* order_;
  PackedSlidable slidable_;
  std::optional<DeviceSlideElements> elements_;  ///< always there, from the constructor on
  DeviceBuffer<std::int32_t> vertices_;          ///< of the Slidable: their numbers in the mesh
  DeviceBuffer<std::int32_t> numbers_;           ///< their packed numbers
  std::vector<std::int32_t> by_packed_;          ///< their numbers in it, ascending by packed number; found when needed
  DeviceBuffer<Point2<double>> points_;          ///< one for each of them
  DeviceBuffer<Point2<double>> held_after_;      ///< HeldView
  DeviceBuffer<std::int32_t> fan_of_;            ///< HeldView
  DeviceBuffer<FanTarget> targets_;
  DeviceBuffer<Point2<double>> stored_slid_;  ///< SlidPoints

  // Of a run:
  const LocalFrame* device_frame_ = nullptr;
  LocalFrame frame_;
  Storage storage_ = Storage::float64;
  std::vector<Point2<double>> stored_;
  bool has_lines_ = false;
  SlideChains local_;  ///< with the numbers of the Slidable
  DeviceChains device_;
  bool has_targets_ = false;
  std::vector<SlidePlace> places_;
  std::vector<Point2<double>> before_;  ///< in the local frame
  std::vector<Point2<double>> after_;
  SlidVertices slid_;
  std::optional<SlideGuard> guard_;
  bool is_judged_by_host_ = false;  ///< the lines are
  std::future<SlideChains> found_;  ///< the lines; the last member, as the thread reads others
};

}  // namespace trismooth::cuda

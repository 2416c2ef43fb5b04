#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/storage.h"
#include "trismooth/cuda/guard/held_view.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/slide/device_chains.h"
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
  /// `order` outlives it. `reversed`: as MeshRings::reversed, of the Slidable's triangles. Waits for the device.
  DeviceSlide(Context& context, const VertexOrder& order, Slidable slidable, std::vector<std::uint8_t> reversed);

  /// Brings the vertices over for a run, as they are stored. `stored`, `frame`: on the device. Waits for it.
  void begin(const Point2<double>* stored, const LocalFrame* frame, Storage storage);
  bool has_lines() const { return has_lines_; }
  /// Finds the lines of the run. False: nothing slides. What has been queued goes on meanwhile, and it takes as long as
  /// a few sweeps: so it comes behind the queuing of those that no vertex slides before.
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

  /// Puts back what the lines do not allow, and lays what is left out for the guard. Calls reverted(vertex, position)
  /// with the caller's number of each vertex that goes back, and where it would have been stored. `before`: as
  /// GuardInput. Returns the rounds. `guards`: triangles count, too. The first time of a run where the places are.
  template <class Reverted>
  std::int64_t settle(bool guards, const Point2<double>* before, const Reverted& reverted) {
    if (!guard_) {
      take_over(guards);
    }
    std::vector<std::int32_t> back;
    const std::int64_t rounds = guard_->settle(back);
    tell(back, reverted);
    place_for_guard(before);
    return rounds;
  }
  /// What the guard on the device has to know.
  HeldView held() { return {held_after_.data(), fan_of_.data(), device_.view().fans, device_.view().sides}; }
  /// Notes what that has put back: packed numbers. Calls reverted() as settle() does.
  template <class Reverted>
  void note_reverted(std::span<const std::int32_t> held, const Reverted& reverted) {
    std::vector<std::int32_t> back;
    for (const std::int32_t v : held) {
      back.push_back(put_back(v));
    }
    tell(back, reverted);
  }
  /// Writes those that are elsewhere to `stored`, adds them to the result and says what became of all.
  void finish(Point2<double>* stored, SmoothingResult& result);

 private:
  void take_over(bool guards);
  void place_for_guard(const Point2<double>* before);
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
  DeviceBuffer<std::int32_t> vertices_;      ///< of the Slidable: their numbers in the mesh
  DeviceBuffer<std::int32_t> numbers_;       ///< likewise: packed
  std::vector<std::int32_t> by_packed_;      ///< their numbers in it, ascending by packed number; found when needed
  DeviceBuffer<Point2<double>> points_;      ///< one for each of them
  DeviceBuffer<Point2<double>> held_after_;  ///< HeldView
  DeviceBuffer<std::int32_t> fan_of_;        ///< likewise
  DeviceBuffer<FanTarget> targets_;

  // Of a run:
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
};

}  // namespace trismooth::cuda

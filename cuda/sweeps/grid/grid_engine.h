// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/cuda/sweeps/grid/grid_sweeps.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// Sweeps by the whole grid over the whole mesh: positions (twice for Form A), rings and marks. `Rings`:
/// GridRings<form> or MixedRings<form>.
template <class T, Form form, class Rings>
class GridEngine {
 public:
  using Points = PointArray<T>;
  /// Both buffers stay where they are, so what comes after the sweeps can be queued before they are done.
  static constexpr bool may_be_followed = true;

  GridEngine(Context& context, const VertexOrder& order, Rings rings, const SmoothingOptions& options)
      : context_(&context),
        method_(options.method),
        batches_(order.batches),
        rings_(std::move(rings)),
        targets_(context, order.vertex_count(), order.free_count(), options) {
    for (std::size_t batch = 0; batch + 1 < batches_.size(); ++batch) {
      largest_batch_ = std::max(largest_batch_, batches_[batch + 1] - batches_[batch]);
    }
    for (std::size_t i = 0; i < buffers; ++i) {
      points_[i] = DeviceBuffer<PointRecord<T>>(context, static_cast<std::size_t>(order.vertex_count()));
      marks_[i] = DeviceBuffer<std::uint32_t>(context, (static_cast<std::size_t>(order.free_count()) + 31) / 32);
    }
    mesh_.rings = rings_.view();
    mesh_.first = {{points_[0].data()}, marks_[0].data()};
    mesh_.second = {{points_[buffers - 1].data()}, marks_[buffers - 1].data()};
  }

  /// An estimate of the device memory that it takes, the rings apart.
  static std::size_t bytes(const MeshSize& size) {
    return buffers * (static_cast<std::size_t>(size.vertices) * sizeof(PointRecord<T>) +
                      static_cast<std::size_t>(size.free_vertices) / 8);
  }

  /// The rings of the free vertices, for kernels.
  auto rings() const { return rings_.view(); }
  /// Where the working positions are to be written before begin() and aim_at_input(): both of these (which may be the
  /// same).
  std::pair<Points, Points> input() const { return {mesh_.first.points, mesh_.second.points}; }
  /// The sizes that are asked for: before the first run, where the options say that they are.
  void set_sizes(const VertexOrder& order, std::span<const double> inverse_sizes) {
    targets_.set_sizes(order, inverse_sizes);
  }
  /// From now on those positions, in a local frame of that exponent, are what the method aims at, if it has targets.
  void aim_at_input(int exponent) { targets_.keep(rings(), mesh_.first.points, exponent); }
  /// Makes ready for a run from those positions, which are in that local frame, on the device.
  void begin(const LocalFrame* frame) { targets_.find(rings(), mesh_.first.points, frame); }
  /// Makes ready for a stage of the run, which begins with a sweep over all vertices.
  void begin_stage() {
    for (DeviceBuffer<std::uint32_t>& marks : marks_) {
      marks.fill_bytes(0);
    }
  }
  /// Queues sweeps until the rules say stop or rules.sweeps are done. Returns how many kernels the host launches.
  std::int64_t sweep(const MeanRatioStep<T>& step, LoopRules rules, LoopState* state, SweepSums* sums) {
    const MethodInUse<T> method{method_, targets_.view(), step};
    std::int64_t launches = 0;
    const bool is_mean_ratio = method_ == Method::mean_ratio;
    // In a stage that is not the last most vertices move to its end.
    rules.evaluates_all = rules.evaluates_all || (is_mean_ratio && !step.is_last && !rules.measures_shape);
    // The smallest shape is measured by the other kernel alone, and batches that do not fill the GPU are not worth a
    // launch each, unless an update takes long.
    const bool sweeps_all = rules.evaluates_all || rules.begins_with_all;
    if (sweeps_all && !rules.measures_shape &&
        (rules.evaluates_all || is_mean_ratio || largest_batch_ >= smallest_launch)) {
      const std::int32_t usual =
          is_mean_ratio ? sweeps_of_last_stage : (form == Form::swap ? sweeps_of_all_a : sweeps_of_all_b);
      const std::int32_t sweeps = rules.evaluates_all ? rules.sweeps : std::min(rules.sweeps, usual);
      launches = launch_sweeps_of_all(method, mesh_, rules, batches_, sweeps, state, sums, context_->stream());
      if (rules.evaluates_all) {
        return launches;
      }
    }
    const std::size_t words = barrier_words(rules);
    if (barriers_.size() < words) {
      barriers_ = DeviceBuffer<unsigned long long>(*context_, words);
    }
    barriers_.fill_bytes(0);
    launch_sweeps_of_marked(method, mesh_, rules, largest_batch_, state, sums, barriers_.data(), context_->stream());
    return launches + 1;
  }
  /// Queues the measuring of the smallest quotient of the triangles with a free vertex, before the first sweep.
  void measure(SweepSums* sums) const {
    launch_smallest_quotient(mesh_.rings, mesh_.first.points, sums, context_->stream());
  }
  /// Marks of the vertices that the next sweep evaluates, `current` being what LoopState says.
  std::uint32_t* marks(std::int32_t current) { return current == 0 ? mesh_.first.marks : mesh_.second.marks; }
  /// Vertices without rings are elsewhere, in both buffers, and their neighbours are marked where there are marks. May
  /// have the next sweep evaluate all vertices.
  void note_slides(LoopState& /*state*/) {}
  const DeviceTargets<T>& targets() const { return targets_; }
  /// Where a run leaves the positions if LoopState::current is 0, and if it is 1. `current` says which it is where the
  /// host knows.
  std::pair<Points, Points> output(std::int32_t /*current*/) const { return input(); }

 private:
  static constexpr std::size_t buffers = form == Form::swap ? 2 : 1;
  static constexpr std::int32_t smallest_launch = 500'000;
  /// Sweeps in which many vertices of a mesh move, as a rule; where they are more, the sweeps over marked vertices
  /// begin with one over all.
  static constexpr std::int32_t sweeps_of_all_a = 18;
  static constexpr std::int32_t sweeps_of_all_b = 9;
  static constexpr std::int32_t sweeps_of_last_stage = 5;

  Context* context_;
  Method method_;
  std::vector<std::int32_t> batches_;
  Rings rings_;
  DeviceTargets<T> targets_;
  DeviceBuffer<PointRecord<T>> points_[buffers];
  DeviceBuffer<std::uint32_t> marks_[buffers];
  GridMesh<T, typename Rings::View> mesh_{};
  std::int32_t largest_batch_ = 0;
  DeviceBuffer<unsigned long long> barriers_;
};

}  // namespace trismooth::cuda

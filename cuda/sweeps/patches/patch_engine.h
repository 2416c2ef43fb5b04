// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/cuda/sweeps/patches/patch_sweeps.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// Sweeps on patches in shared memory. Functions as those of GridEngine.
template <class T>
class PatchEngine {
 public:
  using Points = PointArray<T>;
  static constexpr bool may_be_followed = true;

  PatchEngine(Context& context, const VertexOrder& order, PatchedRings rings, const SmoothingOptions& options)
      : context_(&context),
        method_(options.method),
        free_count_(order.free_count()),
        rings_(std::move(rings)),
        targets_(context, order.vertex_count(), order.free_count(), options),
        shared_bytes_(patch_bytes<T>(rings_.patches, options)) {
    for (std::size_t i = 0; i < 2; ++i) {
      points_[i] = DeviceBuffer<PointRecord<T>>(context, static_cast<std::size_t>(order.vertex_count()));
      moved_[i] = DeviceBuffer<std::uint8_t>(context, static_cast<std::size_t>(free_count_));
    }
    mesh_.patches = rings_.patches.view();
    mesh_.colours = order.colours;
    mesh_.first = {{points_[0].data()}, moved_[0].data()};
    mesh_.second = {{points_[1].data()}, moved_[1].data()};
  }

  RingsView rings() const { return rings_.view(); }
  std::pair<Points, Points> input() const { return {mesh_.first.points, mesh_.second.points}; }
  void set_sizes(const VertexOrder& order, std::span<const double> inverse_sizes) {
    targets_.set_sizes(order, inverse_sizes);
  }
  void aim_at_input(int exponent) { targets_.keep(rings(), mesh_.first.points, exponent); }
  void begin(const LocalFrame* frame) { targets_.find(rings(), mesh_.first.points, frame); }
  void begin_stage() {
    for (DeviceBuffer<std::uint8_t>& moved : moved_) {
      moved.fill_bytes(1);
    }
  }
  std::int64_t sweep(const MeanRatioStep<T>& step, const LoopRules& rules, LoopState* state, SweepSums* sums) {
    const std::size_t groups = static_cast<std::size_t>(rules.sweeps);
    if (words_.size() < 2 * groups) {
      words_ = DeviceBuffer<unsigned long long>(*context_, 2 * groups);
    }
    words_.fill_bytes(0);
    launch_patch_sweeps({method_, targets_.view(), step}, mesh_, rules, shared_bytes_, free_count_, state, sums,
                        words_.data(), words_.data() + groups, context_->stream());
    return 1;
  }
  void measure(SweepSums* sums) const {
    launch_smallest_quotient(rings(), mesh_.first.points, sums, context_->stream());
  }
  std::uint32_t* marks(std::int32_t /*current*/) { return nullptr; }
  void note_slides(LoopState& state) {
    begin_stage();
    state.evaluates_all = 1;
    state.marks = 0;
  }
  const DeviceTargets<T>& targets() const { return targets_; }
  std::pair<Points, Points> output(std::int32_t /*current*/) const { return input(); }

 private:
  Context* context_;
  Method method_;
  std::int32_t free_count_;
  PatchedRings rings_;
  DeviceTargets<T> targets_;
  std::size_t shared_bytes_;
  DeviceBuffer<PointRecord<T>> points_[2];
  DeviceBuffer<std::uint8_t> moved_[2];
  PatchedMesh<T> mesh_{};
  DeviceBuffer<unsigned long long> words_;
};

}  // namespace trismooth::cuda

#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "trismooth/cuda/cdp.h"
#include "trismooth/cuda/packing.h"
#include "trismooth/cuda/paper_mesh.h"
#include "trismooth/cuda/point_arrays.h"
#include "trismooth/cuda/resident.h"
#include "trismooth/cuda/single_block.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// One of the executions at work on one mesh. Owns what it needs beside the packed rings.
template <class T, Layout layout>
class SweepEngine {
 public:
  using Points = PointArrays<T, layout>;

  SweepEngine() = default;
  SweepEngine(const SweepEngine&) = delete;
  SweepEngine& operator=(const SweepEngine&) = delete;
  virtual ~SweepEngine() = default;

  /// Where the working positions are to be written before begin(): both of these (which may be the same).
  virtual std::pair<Points, Points> input() = 0;
  /// Makes ready for a run from those positions.
  virtual void begin() = 0;
  /// Queues sweeps until the rules say stop or rules.sweeps are done.
  virtual void sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) = 0;
  /// The positions that a run has left in the buffer `current`.
  virtual Points output(std::int32_t current) = 0;
};

/// Execution::resident on its own lean structure: positions (twice for Form A), rings and marks.
template <class T, Layout layout>
class ResidentEngine final : public SweepEngine<T, layout> {
 public:
  using Points = PointArrays<T, layout>;

  ResidentEngine(Context& context, const PackedDeviceRings& rings, const SmoothingOptions& options)
      : context_(context), method_(options.method) {
    for (std::size_t batch = 0; batch + 1 < rings.batches.size(); ++batch) {
      largest_batch_ = std::max(largest_batch_, rings.batches[batch + 1] - rings.batches[batch]);
    }
    const bool swaps = options.form == Form::swap;
    const auto count = static_cast<std::size_t>(rings.vertex_count());
    const auto free_count = static_cast<std::size_t>(rings.free_count());
    for (std::size_t i = 0; i < (swaps ? 2U : 1U); ++i) {
      points_[i] = DeviceBuffer<T>(context, 2 * count);
      marked_[i] = DeviceBuffer<std::uint8_t>(context, free_count);
    }
    const std::size_t second = swaps ? 1 : 0;
    mesh_.rings = rings.rings.view();
    mesh_.first = {Points(points_[0].data(), rings.vertex_count()), marked_[0].data()};
    mesh_.second = {Points(points_[second].data(), rings.vertex_count()), marked_[second].data()};
  }

  std::pair<Points, Points> input() override { return {mesh_.first.points, mesh_.second.points}; }
  void begin() override {
    marked_[0].fill_bytes(1);
    marked_[1].fill_bytes(0);
  }
  void sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) override {
    const std::size_t barriers = resident_barriers(rules);
    if (barriers_.size() < barriers) {
      barriers_ = DeviceBuffer<unsigned long long>(context_, barriers);
    }
    barriers_.fill_bytes(0);
    launch_resident(method_, mesh_, rules, largest_batch_, state, sums, barriers_.data(), context_.stream());
  }
  Points output(std::int32_t current) override { return current == 0 ? mesh_.first.points : mesh_.second.points; }

 private:
  Context& context_;
  Method method_;
  DeviceBuffer<T> points_[2];
  DeviceBuffer<std::uint8_t> marked_[2];
  ResidentMesh<T, layout> mesh_{};
  std::int32_t largest_batch_ = 0;
  DeviceBuffer<unsigned long long> barriers_;
};

/// Execution::single_block and Execution::cdp on the paper's mesh structure.
template <class T, Layout layout>
class PaperEngine final : public SweepEngine<T, layout> {
 public:
  using Points = PointArrays<T, layout>;

  PaperEngine(Context& context, const PackedDeviceRings& rings, const SmoothingOptions& options)
      : context_(context),
        method_(options.method),
        with_children_(options.execution == Execution::cdp),
        elements_(find_elements(context, rings.rings.view(), rings.rings.neighbours.size())),
        mesh_(context, rings.rings.view(), rings.vertex_count(), elements_),
        memory_(context, 2 * static_cast<std::size_t>(rings.vertex_count())),
        points_(memory_.data(), rings.vertex_count()) {
    elements_.triangles.reset();
  }

  std::pair<Points, Points> input() override { return {points_, points_}; }
  void begin() override { mesh_.initiate(context_, points_); }
  void sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) override {
    if (with_children_) {
      launch_cdp(method_, mesh_.view(), rules, state, sums, context_.stream());
    } else {
      launch_single_block(method_, mesh_.view(), rules, state, sums, context_.stream());
    }
  }
  Points output(std::int32_t current) override {
    mesh_.read_positions(context_, current, points_);
    return points_;
  }

 private:
  Context& context_;
  Method method_;
  bool with_children_;
  DeviceElements elements_;
  PaperMesh<T, layout> mesh_;
  DeviceBuffer<T> memory_;
  Points points_;
};

template <class T, Layout layout>
std::unique_ptr<SweepEngine<T, layout>> make_sweep_engine(Context& context, const PackedDeviceRings& rings,
                                                          const SmoothingOptions& options) {
  if (options.execution == Execution::resident) {
    return std::make_unique<ResidentEngine<T, layout>>(context, rings, options);
  }
  return std::make_unique<PaperEngine<T, layout>>(context, rings, options);
}

}  // namespace trismooth::cuda

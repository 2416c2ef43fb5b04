#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "trismooth/cuda/packing/packing.h"
#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/cuda/paper/paper_mesh.h"
#include "trismooth/cuda/paper/single_block.h"
#include "trismooth/cuda/primitives/point_arrays.h"
#include "trismooth/cuda/sweeps/grid/resident.h"
#include "trismooth/cuda/sweeps/patches/patch_sweeps.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
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
  /// Queues sweeps until the rules say stop or rules.sweeps are done. Returns how many kernels the host launches.
  virtual std::int64_t sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) = 0;
  /// Queues the measuring of the smallest quotient of the triangles with a free vertex, before the first sweep.
  virtual void measure(SweepSums* sums) = 0;
  /// The positions that a run has left in the buffer `current`.
  virtual Points output(std::int32_t current) = 0;
};

/// Execution::resident on its own lean structure: positions (twice for Form A), rings and marks.
template <class T, Layout layout, class Slot>
class ResidentEngine final : public SweepEngine<T, layout> {
 public:
  using Points = PointArrays<T, layout>;

  ResidentEngine(Context& context, const PackedDeviceRings& packed, const SlottedRings<Slot>& rings,
                 const SmoothingOptions& options)
      : context_(context), method_(options.method), batches_(packed.batches) {
    for (std::size_t batch = 0; batch + 1 < batches_.size(); ++batch) {
      largest_batch_ = std::max(largest_batch_, batches_[batch + 1] - batches_[batch]);
    }
    const bool swaps = options.form == Form::swap;
    const auto count = static_cast<std::size_t>(packed.vertex_count());
    for (std::size_t i = 0; i < (swaps ? 2U : 1U); ++i) {
      points_[i] = DeviceBuffer<T>(context, 2 * count);
      marks_[i] = DeviceBuffer<std::uint32_t>(context, (static_cast<std::size_t>(packed.free_count()) + 31) / 32);
    }
    const std::size_t second = swaps ? 1 : 0;
    mesh_.rings = rings.view();
    mesh_.first = {Points(points_[0].data(), packed.vertex_count()), marks_[0].data()};
    mesh_.second = {Points(points_[second].data(), packed.vertex_count()), marks_[second].data()};
  }

  std::pair<Points, Points> input() override { return {mesh_.first.points, mesh_.second.points}; }
  void begin() override {
    marks_[0].fill_bytes(0);
    marks_[1].fill_bytes(0);
  }
  std::int64_t sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) override {
    std::int64_t launches = 0;
    // The smallest shape is measured by the other kernel alone, and batches that do not fill the GPU are not worth a
    // launch each.
    if (!rules.measures_shape && (rules.evaluates_all || largest_batch_ >= smallest_launch)) {
      const std::int32_t usual = rules.swaps ? sweeps_of_all_a : sweeps_of_all_b;
      const std::int32_t sweeps = rules.evaluates_all ? rules.sweeps : std::min(rules.sweeps, usual);
      launches = launch_sweeps_of_all(method_, mesh_, rules, batches_, sweeps, state, sums, context_.stream());
      if (rules.evaluates_all) {
        return launches;
      }
    }
    const std::size_t barriers = resident_barriers(rules);
    if (barriers_.size() < barriers) {
      barriers_ = DeviceBuffer<unsigned long long>(context_, barriers);
    }
    barriers_.fill_bytes(0);
    launch_sweeps_of_marked(method_, mesh_, rules, largest_batch_, state, sums, barriers_.data(), context_.stream());
    return launches + 1;
  }
  void measure(SweepSums* sums) override {
    launch_smallest_quotient(mesh_.rings, mesh_.first.points, sums, context_.stream());
  }
  Points output(std::int32_t current) override { return current == 0 ? mesh_.first.points : mesh_.second.points; }

 private:
  static constexpr std::int32_t smallest_launch = 500'000;
  /// Sweeps in which many vertices of a mesh move, as a rule; where they are more, the sweeps over marked vertices
  /// begin with one over all.
  static constexpr std::int32_t sweeps_of_all_a = 18;
  static constexpr std::int32_t sweeps_of_all_b = 9;

  Context& context_;
  Method method_;
  std::vector<std::int32_t> batches_;
  DeviceBuffer<T> points_[2];
  DeviceBuffer<std::uint32_t> marks_[2];
  ResidentMesh<T, layout, Slot> mesh_{};
  std::int32_t largest_batch_ = 0;
  DeviceBuffer<unsigned long long> barriers_;
};

/// Execution::resident on patches in shared memory.
template <class T, Layout layout>
class PatchEngine final : public SweepEngine<T, layout> {
 public:
  using Points = PointArrays<T, layout>;

  PatchEngine(Context& context, const PackedDeviceRings& packed, const SmoothingOptions& options)
      : context_(context),
        method_(options.method),
        free_count_(packed.free_count()),
        shared_bytes_(patch_bytes<T>(*packed.patches, options.form == Form::swap)) {
    const auto count = static_cast<std::size_t>(packed.vertex_count());
    for (std::size_t i = 0; i < 2; ++i) {
      points_[i] = DeviceBuffer<T>(context, 2 * count);
      moved_[i] = DeviceBuffer<std::uint8_t>(context, static_cast<std::size_t>(free_count_));
    }
    mesh_.patches = packed.patches->view();
    mesh_.colours = packed.colours;
    mesh_.first = {Points(points_[0].data(), packed.vertex_count()), moved_[0].data()};
    mesh_.second = {Points(points_[1].data(), packed.vertex_count()), moved_[1].data()};
  }

  std::pair<Points, Points> input() override { return {mesh_.first.points, mesh_.second.points}; }
  void begin() override { moved_[0].fill_bytes(1); }
  std::int64_t sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) override {
    const std::size_t groups = static_cast<std::size_t>(rules.sweeps);
    if (words_.size() < 2 * groups) {
      words_ = DeviceBuffer<unsigned long long>(context_, 2 * groups);
    }
    words_.fill_bytes(0);
    launch_patch_sweeps(method_, mesh_, rules, shared_bytes_, free_count_, state, sums, words_.data(),
                        words_.data() + groups, context_.stream());
    return 1;
  }
  void measure(SweepSums* /*sums*/) override {}
  Points output(std::int32_t current) override { return current == 0 ? mesh_.first.points : mesh_.second.points; }

 private:
  Context& context_;
  Method method_;
  std::int32_t free_count_;
  std::size_t shared_bytes_;
  DeviceBuffer<T> points_[2];
  DeviceBuffer<std::uint8_t> moved_[2];
  PatchedMesh<T, layout> mesh_{};
  DeviceBuffer<unsigned long long> words_;
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
        rings_(rings.rings.view()),
        elements_(find_elements(context, rings.rings.view(), rings.rings.neighbours.size())),
        mesh_(context, rings.rings.view(), rings.vertex_count(), elements_),
        memory_(context, 2 * static_cast<std::size_t>(rings.vertex_count())),
        points_(memory_.data(), rings.vertex_count()) {
    elements_.triangles.reset();
  }

  std::pair<Points, Points> input() override { return {points_, points_}; }
  void begin() override { mesh_.initiate(context_, points_); }
  std::int64_t sweep(const LoopRules& rules, LoopState* state, SweepSums* sums) override {
    if (with_children_) {
      launch_cdp(method_, mesh_.view(), rules, state, sums, context_.stream());
    } else {
      launch_single_block(method_, mesh_.view(), rules, state, sums, context_.stream());
    }
    return 1;
  }
  void measure(SweepSums* sums) override { launch_smallest_quotient(rings_, points_, sums, context_.stream()); }
  Points output(std::int32_t current) override {
    mesh_.read_positions(context_, current, points_);
    return points_;
  }

 private:
  Context& context_;
  Method method_;
  bool with_children_;
  RingsView rings_;
  DeviceElements elements_;
  PaperMesh<T, layout> mesh_;
  DeviceBuffer<T> memory_;
  Points points_;
};

template <class T, Layout layout>
std::unique_ptr<SweepEngine<T, layout>> make_sweep_engine(Context& context, const PackedDeviceRings& rings,
                                                          const SmoothingOptions& options) {
  if (rings.patches != nullptr) {
    return std::make_unique<PatchEngine<T, layout>>(context, rings, options);
  }
  if (options.execution == Execution::resident && options.form == Form::swap) {
    return std::make_unique<ResidentEngine<T, layout, std::int16_t>>(context, rings, rings.near_rings, options);
  }
  if (options.execution == Execution::resident) {
    return std::make_unique<ResidentEngine<T, layout, std::int32_t>>(context, rings, rings.wide_rings, options);
  }
  return std::make_unique<PaperEngine<T, layout>>(context, rings, options);
}

}  // namespace trismooth::cuda

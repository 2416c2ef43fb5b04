// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/cuda/paper/paper_mesh.h"
#include "trismooth/cuda/paper/single_block.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/sweeps/sweep_state.h"

namespace trismooth::cuda {

/// The paper's two versions on its mesh structure. Functions as those of GridEngine.
template <class T, Layout layout>
class PaperEngine {
 public:
  using Points = PointArray<T>;
  /// Positions are copied out of the structure, from a buffer that the host has to know.
  static constexpr bool may_be_followed = false;

  PaperEngine(Context& context, const VertexOrder& order, PaperRings<layout> rings, const SmoothingOptions& options)
      : context_(&context),
        method_(options.method),
        rings_(std::move(rings)),
        elements_(find_elements(context, rings_.view(), rings_.rings.neighbours.size())),
        mesh_(context, rings_.view(), order.vertex_count(), elements_),
        memory_(context, static_cast<std::size_t>(order.vertex_count())),
        points_{memory_.data()},
        targets_(context, order.vertex_count(), order.free_count(), options) {
    elements_.triangles.reset();
  }

  static std::size_t bytes(const MeshSize& size) {
    const auto vertices = static_cast<std::size_t>(size.vertices);
    const auto ring_entries = static_cast<std::size_t>(size.ring_entries);
    // A triangle has up to three places in the rings, and a mesh of the plane has two for each vertex at most.
    const std::size_t triangles = std::min(ring_entries, 2 * vertices);
    return vertices * (sizeof(VertexRecord<T>) + 2 * sizeof(PointRecord<T>)) +
           triangles * (sizeof(TriangleRecord<T>) + sizeof(TriangleVertices)) + ring_entries * sizeof(std::uint32_t);
  }

  RingsView rings() const { return rings_.view(); }
  std::pair<Points, Points> input() const { return {points_, points_}; }
  /// Never: no method of the paper aims at sizes.
  void set_sizes(const VertexOrder& /*order*/, std::span<const double> /*inverse_sizes*/) {}
  /// No method of the paper aims at anything.
  void aim_at_input(int /*exponent*/) {}
  void begin(const LocalFrame* /*frame*/) { mesh_.initiate(*context_, points_); }
  void begin_stage() {}
  std::int64_t sweep(const MeanRatioStep<T>& /*step*/, const LoopRules& rules, LoopState* state, SweepSums* sums) {
    if (rings_.with_children) {
      launch_cdp(method_, mesh_.view(), rules, state, sums, context_->stream());
    } else {
      launch_single_block(method_, mesh_.view(), rules, state, sums, context_->stream());
    }
    return 1;
  }
  void measure(SweepSums* sums) const { launch_smallest_quotient(rings(), points_, sums, context_->stream()); }
  std::uint32_t* marks(std::int32_t /*current*/) { return nullptr; }
  /// Never: what slides is not in the paper's structure.
  void note_slides(LoopState& /*state*/) {}
  const DeviceTargets<T>& targets() const { return targets_; }
  std::pair<Points, Points> output(std::int32_t current) {
    mesh_.read_positions(*context_, current, points_);
    return input();
  }

 private:
  Context* context_;
  Method method_;
  PaperRings<layout> rings_;
  DeviceElements elements_;
  PaperMesh<T, layout> mesh_;
  DeviceBuffer<PointRecord<T>> memory_;
  Points points_;
  DeviceTargets<T> targets_;  ///< empty: the method has none
};

}  // namespace trismooth::cuda

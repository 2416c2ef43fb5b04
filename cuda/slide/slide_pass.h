// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/slide/slide_update.h"

namespace trismooth::cuda {

/// What a pass over sliding vertices reads and writes. All is on the device.
template <class T>
struct SlideWork {
  SlideView view;
  SlidePlaces places;
  PointArray<T> first;          ///< all packed vertices as the sweeps left them, if LoopState::current is 0...
  PointArray<T> second;         ///< ...and if it is 1. Both are to know where vertices slide; may be the same
  const FanTarget* targets;     ///< of the mean-ratio method, else null
  std::uint32_t* first_marks;   ///< of the free vertices that the next sweep evaluates, if current is 0; null: none
  std::uint32_t* second_marks;  ///< those if it is 1
  std::int32_t free_count;
  T tolerance;
};

/// Queues a pass behind sweeps: what SlidePass does on the host, but that all sliders are evaluated. `batches`: their
/// colours. It is made where the sweeps have settled, or if they are as many as `due_after`; nobody has to have waited
/// for them. Adds to the sums of the last of them. Returns the number of launches.
template <class T>
std::int64_t launch_slide_pass(const MethodInUse<T>& method, const SlideWork<T>& work,
                               std::span<const std::int32_t> batches, std::int32_t due_after, const LoopState* state,
                               SweepSums* sums, cudaStream_t stream);

/// What DeviceTargets knows of the mesh as a whole.
struct MeshAims {
  const MeanRatioSums* sums;  ///< on the device
  double size_weight;
  int power;
  bool has_sizes;
};

/// Queues the finding of targets[s] for each of the sliders: see fan_target(). `places`: those of the input;
/// `before`: all packed vertices as they are stored, in the local frame.
template <class T>
void launch_fan_targets(const Context& context, const SlideView& view, SlidePlaces places, const Point2<double>* before,
                        std::int32_t slider_count, const MeshAims& aims, const T* inverse_areas, FanTarget* targets);

}  // namespace trismooth::cuda

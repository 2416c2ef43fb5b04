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
  PointArray<T> points;        ///< all packed vertices, as the last sweep left them
  PointArray<T> other_points;  ///< the other buffer, which is to know where they slide too; may be the same
  const FanTarget* targets;    ///< of the mean-ratio method, else null
  std::uint32_t* marks;        ///< of the free vertices that the next sweep is to evaluate; null: there are none
  std::int32_t free_count;
  T tolerance;
};

/// Queues a pass: what SlidePass does on the host, but that all sliders are evaluated. `batches`: their colours. Adds
/// to the sums of the sweep that it follows. Returns the number of launches.
template <class T>
std::int64_t launch_slide_pass(const MethodInUse<T>& method, const SlideWork<T>& work,
                               std::span<const std::int32_t> batches, SweepSums* sums, cudaStream_t stream);

/// What DeviceTargets knows of the mesh as a whole.
struct MeshAims {
  const MeanRatioSums* sums;  ///< on the device
  double size_weight;
  int power;
  bool has_sizes;
};

/// Queues the finding of targets[s] for each of the sliders: see fan_target().
template <class T>
void launch_fan_targets(const Context& context, const SlideWork<T>& work, std::int32_t slider_count,
                        const MeshAims& aims, const T* inverse_areas, FanTarget* targets);

}  // namespace trismooth::cuda

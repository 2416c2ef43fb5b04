#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// What the mean-ratio method aims at, in device memory: the same bits as HostTargets.
template <class T>
class DeviceTargets {
 public:
  /// Room for a mesh; none where the method is another one.
  DeviceTargets(Context& context, std::int32_t vertex_count, std::int32_t free_count, const SmoothingOptions& options);

  /// The device memory that it takes.
  static std::size_t bytes(std::int64_t vertex_count, std::int64_t free_count, const SmoothingOptions& options);

  /// Queues the finding for smoothing from these positions. Nothing where the method is another one. `Rings`: RingsView
  /// or SlottedRingsView.
  template <class Rings>
  void find(const Rings& rings, const PointArray<T>& points);

  MeanRatioTargets<T> view() const {
    return {inverse_areas_.data(), largest_shares_.data(), scales_.data(),
            reference_.size() > 0 ? &reference_.data()->x : nullptr};
  }

 private:
  Context* context_;
  MeanRatioOptions options_;
  DeviceBuffer<T> inverse_areas_;   ///< one a vertex
  DeviceBuffer<T> largest_shares_;  ///< one a free vertex
  DeviceBuffer<MeanRatioScales<T>> scales_;
  DeviceBuffer<MeanRatioSums> sums_;
  DeviceBuffer<FixedVertexArea> fixed_;  ///< one a fixed vertex
  DeviceBuffer<PointRecord<T>> reference_;
};

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "trismooth/base/local_frame.h"
#include "trismooth/cuda/packing/vertex_order.h"
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

  /// The sizes that are asked for, as HostTargets takes them: before find(), where the options say that they are.
  void set_sizes(const VertexOrder& order, std::span<const double> inverse_sizes);

  /// From now on find() aims at what it aims at for these positions in a local frame of that exponent, of a mesh that
  /// has moved since: see HostTargets::moved().
  template <class Rings>
  void keep(const Rings& rings, const PointArray<T>& points, int exponent);

  /// Queues the finding for smoothing from these positions. Nothing where the method is another one. `Rings`:
  /// RingsView, SlottedRingsView or SlottedMixedRingsView. `frame`: the local frame that they are in, on the device.
  template <class Rings>
  void find(const Rings& rings, const PointArray<T>& points, const LocalFrame* frame);

  /// What find() has found of the mesh as a whole; see MeanRatioMesh::of().
  const MeanRatioSums* sums() const { return sums_.data(); }
  double size_weight() const { return size_weight_; }
  int power() const { return power_; }
  bool has_sizes() const { return inverse_sizes_.size() > 0; }

  MeanRatioTargets<T> view() const {
    return {inverse_areas_.data(), largest_shares_.data(), scales_.data(), edges_.data()};
  }

 private:
  /// Another mesh that is aimed at.
  struct Reference {
    DeviceBuffer<PointRecord<T>> points;
    DeviceBuffer<T> inverse_areas;
    DeviceBuffer<T> largest_shares;
    DeviceBuffer<EdgeTensor<T>> edges;
    int exponent;
  };

  template <class Rings>
  void find_anew(const Rings& rings, const PointArray<T>& points);

  Context* context_;
  double size_weight_;
  int power_;
  DeviceBuffer<T> inverse_areas_;   ///< one a vertex
  DeviceBuffer<T> largest_shares_;  ///< one a free vertex
  DeviceBuffer<MeanRatioScales<T>> scales_;
  DeviceBuffer<MeanRatioSums> sums_;
  DeviceBuffer<FixedVertexArea> fixed_;  ///< one a fixed vertex, where no sizes are asked for
  DeviceBuffer<T> inverse_sizes_;        ///< one a vertex, where they are
  DeviceBuffer<EdgeTensor<T>> around_;   ///< edges around each vertex, where shapes are to be kept
  DeviceBuffer<EdgeTensor<T>> edges_;    ///< MeanRatioTargets::edges, where shapes are to be kept
  std::optional<Reference> reference_;   ///< see keep()
};

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// The smallest and the largest coordinates of some points.
struct BoundingBox {
  Point2<double> low;
  Point2<double> high;
};

/// Where points are.
struct Extent {
  BoundingBox box{};                   ///< of those that count
  LocalFrame frame;                    ///< local_frame() of the box; the identity where no point counts
  std::int32_t first_not_finite = -1;  ///< number of the first point with a coordinate that is not finite; -1: none is.
                                       ///< Box and frame mean nothing where there is one
};

/// What the blocks of the search tell each other, all zeros between two searches. Keys, so that atomics can compare.
struct ExtentKeys {
  unsigned long long low_x;  ///< falling_key() of the smallest
  unsigned long long low_y;
  unsigned long long high_x;  ///< falling_key() of the smallest negated, which is the largest
  unsigned long long high_y;
  unsigned first_not_finite;  ///< ~ of its number: the largest key is that of the first point; 0: none
  unsigned finished_blocks;
};

/// Finds the extent of points on the device, in one launch, and keeps it there.
class ExtentFinder {
 public:
  explicit ExtentFinder(Context& context);

  /// Queues the search. `points` are aligned to 16 bytes. Those that are hold::is_unused() by their byte of `reasons`
  /// do not count, but are looked at for being finite; null: all count.
  void find(const Point2<double>* points, std::int32_t count, const std::uint8_t* reasons = nullptr);

  /// On the device: the local frame of the points last searched.
  const LocalFrame* frame() const { return &found_.data()->frame; }
  /// Waits for what the last search has found.
  Extent extent() const;

 private:
  Context* context_;
  DeviceBuffer<ExtentKeys> keys_;
  DeviceBuffer<Extent> found_;
};

/// The bounding box of `count` finite points (at least one) on the device, aligned to 16 bytes. Waits for the answer.
BoundingBox bounding_box(Context& context, const Point2<double>* points, std::int32_t count);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/components.h"
#include "trismooth/cuda/topology/mixed_list.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// The orientation of every element.
struct DeviceOrientation {
  bool is_known = false;                ///< since the first call of orient()
  DeviceBuffer<std::uint8_t> turned;    ///< 1 for each component whose lowest element is listed clockwise
  DeviceBuffer<std::uint8_t> reversed;  ///< 1 for each element that is
};

/// Orients each component so that the majority of its elements is positive; a tie makes its lowest-numbered
/// non-degenerate element positive: trismooth::orient(). `elements`: a TriangleList or a MixedList; `points` are in the
/// local frame. Returns whether anything has changed since the last time, or this is the first time. Waits for the
/// device.
template <class List>
bool orient(Context& context, const List& elements, const Point2<double>* points, const Components& components,
            DeviceOrientation& orientation);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/mixed_list.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// trismooth::FixedElements::smallest_quotient(). `elements`: a TriangleList or a MixedList. Waits for the device.
template <class List>
double smallest_fixed_quotient(Context& context, const List& elements, const Point2<double>* points,
                               const std::uint8_t* reversed, const std::uint8_t* fixed);

/// The elements that are inverted, and those without area.
struct InvalidCounts {
  std::int64_t inverted = 0;
  std::int64_t degenerate = 0;
};

/// Those of the mesh with its points as they are stored. `elements`: a TriangleList or a MixedList; `frame`: the local
/// frame, on the device; `reversed`: one byte an element. Waits for the device.
template <class List>
InvalidCounts invalid_elements(Context& context, const List& elements, const Point2<double>* stored,
                               const LocalFrame* frame, const std::uint8_t* reversed);

}  // namespace trismooth::cuda

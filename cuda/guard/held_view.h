#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/slide/slide_view.h"

namespace trismooth::cuda {

/// Vertices that have moved without having a ring, for the guard: those held to a line. On the device; all null where
/// there are none.
struct HeldView {
  Point2<double>* after = nullptr;       ///< of every vertex without a ring, in packed order, in the local frame
  const std::int32_t* fan_of = nullptr;  ///< likewise: that of the vertex; -1: it does not slide
  const std::int32_t* fans = nullptr;    ///< as SlideView
  const FanSide* sides = nullptr;
};

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/sliding.h"

/// The chains that vertices slide on, as a device takes them: plain arrays that somebody else owns. A chain's knots are
/// its vertices where they were in the input, in the local frame; what is between two knots is a segment. Places on a
/// chain are told by their distance along it from its first knot (their "arc").
namespace trismooth {

/// A chain, or several that slide as one: copies of the same number of knots. Arcs are those of the first copy; what is
/// at a part of a segment there is at the same part of that segment on the others.
struct SlideChain {
  std::int32_t first;  ///< knot
  std::int32_t count;  ///< of knots, in each copy; those of copy c begin at first + c * count
  std::int32_t copies;
  bool is_closed;  ///< a segment leads from the last knot to the first; else both are ends, which stay
  double length;   ///< of the whole chain
};

/// A vertex that slides, and with it those at the same knot of the other copies.
struct Slider {
  std::int32_t chain;
  std::int32_t knot;  ///< in the first copy
};

/// A triangle around a sliding vertex: the other two corners, counter-clockwise. Packed numbers.
struct FanSide {
  std::int32_t from;
  std::int32_t to;
  /// Nothing is known of the area that is aimed at around that corner, which has no free neighbour.
  bool from_is_unknown;
  bool to_is_unknown;
};

struct SlideView {
  const SlideChain* chains = nullptr;
  // By knot, of all copies:
  const Point2<double>* knots = nullptr;
  const std::int32_t* vertices = nullptr;  ///< packed numbers
  const std::int32_t* fan_at = nullptr;    ///< the fan of the vertex
  // By knot of the first copy:
  const double* arcs = nullptr;
  const std::uint8_t* bends = nullptr;  ///< 0 where the polyline is straight to rounding
  const double* limits = nullptr;       ///< how far the new line may be from it before it is stored, which rounds...
  const double* allowed = nullptr;      ///< ...and how far it may be then
  const double* lengths = nullptr;      ///< of the shorter one of both segments
  const Slider* sliders = nullptr;
  const std::int32_t* fans = nullptr;  ///< sides[fans[f]] .. sides[fans[f + 1]] are those of fan f
  const FanSide* sides = nullptr;
  SlideCurve curve = SlideCurve::polyline;
};

}  // namespace trismooth

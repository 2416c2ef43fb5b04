// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/ring_elements.h"
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

/// Another corner of an element around a sliding vertex.
struct FanNode {
  std::int32_t vertex;  ///< packed number
  bool is_unknown;  ///< nothing is known of the area that is aimed at around it: it shares no element with a free one
};

/// An element around a sliding vertex: its other corners, counter-clockwise. Sides of the vertex end at the first and
/// at the last of them.
struct FanSide {
  FanNode from;
  FanNode opposite;  ///< no_corner in a triangle
  FanNode to;

  /// What body() returns of the corner at the vertex, of these nodes.
  template <class Body>
  TRISMOOTH_HOST_DEVICE auto with_corner(const Body& body) const {
    return opposite.vertex == no_corner ? body(TriangleCorner<FanNode>{from, to})
                                        : body(QuadrilateralCorner<FanNode>{from, opposite, to});
  }
  /// Calls visit(vertex) for the other corners.
  template <class Visit>
  TRISMOOTH_HOST_DEVICE void for_each(const Visit& visit) const {
    visit(from.vertex);
    if (opposite.vertex != no_corner) {
      visit(opposite.vertex);
    }
    visit(to.vertex);
  }
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

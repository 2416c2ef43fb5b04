// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/slide/slide_curve.h"

namespace trismooth {

/// The largest of some distances in units of a limit that each has; above 1: it is not allowed.
struct LargestShare {
  double value = 0;

  TRISMOOTH_HOST_DEVICE void add(double distance, double limit) {
    const double share = distance > 0 ? distance / limit : 0;
    // (A share that is no number is one too many.)
    value = value >= share ? value : share;
  }
};

/// The part of the way from `from` to `to`, 0 to 1, that is nearest to `point`.
inline TRISMOOTH_HOST_DEVICE double nearest_part(Point2<double> from, Point2<double> to, Point2<double> point) {
  const Point2<double> way = to - from;
  const double squared = squared_length(way);
  const Point2<double> off = point - from;
  const double part = squared > 0 ? (off.x * way.x + off.y * way.y) / squared : 0;
  return part > 0 ? (part < 1 ? part : 1) : 0;
}

/// The distance of a point from the place at `part` of the way from `from` to `to`. `is_foot`: that is where the
/// perpendicular through the point meets it; a point on an edge along an axis is at 0 from it then, to the last bit.
inline TRISMOOTH_HOST_DEVICE double distance_from_edge(Point2<double> from, Point2<double> to, Point2<double> point,
                                                       double part, bool is_foot) {
  const Point2<double> way = to - from;
  if (is_foot) {
    return std::abs(cross(point - from, way)) / std::sqrt(squared_length(way));
  }
  const Point2<double> on_edge{from.x + part * way.x, from.y + part * way.y};
  return std::sqrt(squared_length(point - on_edge));
}

/// The deviation of the edge from `start` to `end`, which are at the places `first` and `last` of a chain, in this
/// order: calls visit(distance, i, j) for distances of which the largest is the deviation, each with the knots (maybe
/// one) at whose edges it is. Both lines are walked through together: knots of the old one are met at the nearest part
/// of the edge that does not lie behind the last one's, what is between is interpolated. The distance of two such
/// walkers is largest at knots and ends, so it is known exactly, and the Hausdorff distance of the lines is no larger
/// (nor their Frechet distance). Where only knots differ from the edge, and are met in their order, it is the Hausdorff
/// distance of both parts. Complexity: linear in the knots between.
template <class Visit>
TRISMOOTH_HOST_DEVICE void for_deviations(const ChainCurve& curve, std::int32_t copy, const SlidePlace& first,
                                          Point2<double> start, const SlidePlace& last, Point2<double> end,
                                          const Visit& visit) {
  visit(std::sqrt(squared_length(start - curve.on_polyline(first, copy))), first.segment, first.segment + 1);
  visit(std::sqrt(squared_length(end - curve.on_polyline(last, copy))), last.segment, last.segment + 1);
  double met = 0;
  for (std::int32_t i = first.segment + 1; curve.arc(i) < last.arc; ++i) {
    const Point2<double> knot = curve.knot(i, copy);
    const double nearest = nearest_part(start, end, knot);
    const bool is_foot = nearest > 0 && nearest < 1 && nearest >= met;
    met = nearest > met ? nearest : met;
    visit(distance_from_edge(start, end, knot, met, is_foot), i, i);
  }
}

/// The largest share of what the chain's limits allow that an edge takes: see for_deviations().
inline TRISMOOTH_HOST_DEVICE_CALL double deviation_share(const ChainCurve& curve, std::int32_t copy,
                                                         const SlidePlace& first, Point2<double> start,
                                                         const SlidePlace& last, Point2<double> end) {
  LargestShare largest;
  for_deviations(curve, copy, first, start, last, end,
                 [&](double distance, std::int32_t i, std::int32_t j) { largest.add(distance, curve.limit(i, j)); });
  return largest.value;
}

/// How far the lines of a result are from those of the input.
struct LineDeviation {
  double distance = 0;  ///< the largest, in the local frame
  double relative = 0;  ///< the largest part of the length of the edge nearby
};

/// What is to be said of an edge of the new line.
struct JudgedEdge {
  bool is_good;             ///< its ends are one behind the other, apart, and it is no further off than it may be
  LineDeviation deviation;  ///< on all copies, where it is good
};

/// Judges the edge from knot i of a chain's first copy to the next one (on a closed chain the first one follows the
/// last), as it will be stored. `places`: of the knots of the view; `after(vertex)`: where its vertices would be
/// stored, in the local frame.
template <class Points>
TRISMOOTH_HOST_DEVICE JudgedEdge judge_edge(const ChainCurve& curve, const SlideView& view, const SlidePlace* places,
                                            std::int32_t i, const Points& after) {
  const SlideChain& chain = curve.chain();
  const bool is_seam = i + 1 == chain.count;
  const std::int32_t first = chain.first + i;
  const std::int32_t second = is_seam ? chain.first : first + 1;
  const SlidePlace from = places[first];
  SlidePlace to = places[second];
  if (is_seam) {
    to = {to.arc + chain.length, to.segment + chain.count};
  }
  JudgedEdge found{from.arc < to.arc, {}};
  for (std::int32_t copy = 0; found.is_good && copy < chain.copies; ++copy) {
    const Point2<double> start = after(view.vertices[first + copy * chain.count]);
    const Point2<double> end = after(view.vertices[second + copy * chain.count]);
    LargestShare of_allowed;
    LargestShare of_length;
    double largest = 0;
    for_deviations(curve, copy, from, start, to, end, [&](double distance, std::int32_t j, std::int32_t k) {
      largest = distance > largest ? distance : largest;
      of_allowed.add(distance, curve.allowed(j, k));
      of_length.add(distance, curve.length(j, k));
    });
    LineDeviation& deviation = found.deviation;
    deviation.distance = largest > deviation.distance ? largest : deviation.distance;
    deviation.relative = of_length.value > deviation.relative ? of_length.value : deviation.relative;
    // (Two vertices may be stored at the same place, of few digits.)
    found.is_good = of_allowed.value <= 1 && !(start == end);
  }
  return found;
}

}  // namespace trismooth

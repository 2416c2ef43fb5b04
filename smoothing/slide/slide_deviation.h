#pragma once

#include <cmath>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/slide/slide_curve.h"

namespace trismooth {

/// How far an edge of the new line is from the part of the old one that it replaces, in units of what is allowed.
struct EdgeDeviation {
  double distance = 0;  ///< in the local frame
  double share = 0;     ///< the largest of (distance / limit) where they differ; above 1: it is not allowed

  TRISMOOTH_HOST_DEVICE void add(double apart, double limit) {
    distance = apart > distance ? apart : distance;
    const double of_limit = apart > 0 ? apart / limit : 0;
    // (A share that is no number is one too many.)
    share = share >= of_limit ? share : of_limit;
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
/// order. Both lines are walked through together: knots of the old one are met at the nearest part of the edge that
/// does not lie behind the last one's, what is between is interpolated. The distance of two such walkers is largest at
/// knots and ends, so it is known exactly, and the Hausdorff distance of the lines is no larger (nor their Frechet
/// distance). Where only knots differ from the edge, and are met in their order, it is the Hausdorff distance of both
/// parts. Complexity: linear in the knots between.
inline TRISMOOTH_HOST_DEVICE EdgeDeviation deviation_of(const ChainCurve& curve, std::int32_t copy,
                                                        const SlidePlace& first, Point2<double> start,
                                                        const SlidePlace& last, Point2<double> end) {
  EdgeDeviation found;
  const auto limit_at = [&](const SlidePlace& place) {
    const double before = curve.limit(place.segment);
    const double after = curve.limit(place.segment + 1);
    return before < after ? before : after;
  };
  found.add(std::sqrt(squared_length(start - curve.on_polyline(first, copy))), limit_at(first));
  found.add(std::sqrt(squared_length(end - curve.on_polyline(last, copy))), limit_at(last));
  double met = 0;
  for (std::int32_t i = first.segment + 1; curve.arc(i) < last.arc; ++i) {
    const Point2<double> knot = curve.knot(i, copy);
    const double nearest = nearest_part(start, end, knot);
    const bool is_foot = nearest > 0 && nearest < 1 && nearest >= met;
    met = nearest > met ? nearest : met;
    found.add(distance_from_edge(start, end, knot, met, is_foot), curve.limit(i));
  }
  return found;
}

}  // namespace trismooth

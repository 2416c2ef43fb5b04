// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/slide/slide_view.h"

/// Places on chains. Only + - * / and square roots, in double and in a fixed order: the same bits everywhere.
namespace trismooth {

/// A place on a chain.
struct SlidePlace {
  double arc;
  /// arc is from that of this knot on and below that of the next. On a closed chain knots are counted on, round after
  /// round: knot i is i modulo their number.
  std::int32_t segment;
};

/// One chain of the view.
class ChainCurve {
 public:
  TRISMOOTH_HOST_DEVICE ChainCurve(const SlideView& view, std::int32_t chain)
      : view_(view), chain_(view.chains[chain]) {}

  const TRISMOOTH_HOST_DEVICE SlideChain& chain() const { return chain_; }

  /// The place of a knot, counted from the chain's first one.
  TRISMOOTH_HOST_DEVICE SlidePlace at_knot(std::int32_t i) const { return {arc(i), segment_at(i)}; }

  /// The place at `arc`, found from a place nearby.
  TRISMOOTH_HOST_DEVICE SlidePlace at(double wanted, std::int32_t segment) const {
    while (wanted < arc(segment) && (chain_.is_closed || segment > 0)) {
      --segment;
    }
    while (wanted >= arc(segment + 1) && (chain_.is_closed || segment < chain_.count - 2)) {
      ++segment;
    }
    return {wanted, segment};
  }

  TRISMOOTH_HOST_DEVICE double arc(std::int32_t i) const {
    if (!chain_.is_closed) {
      return view_.arcs[chain_.first + i];
    }
    const std::int32_t wrapped = wrap(i);
    const std::int32_t rounds = (i - wrapped) / chain_.count;
    return view_.arcs[chain_.first + wrapped] + static_cast<double>(rounds) * chain_.length;
  }
  TRISMOOTH_HOST_DEVICE Point2<double> knot(std::int32_t i, std::int32_t copy) const {
    return view_.knots[chain_.first + copy * chain_.count + wrap(i)];
  }
  /// Whether the polyline bends at a knot between two places.
  TRISMOOTH_HOST_DEVICE bool bends_between(const SlidePlace& first, const SlidePlace& last) const {
    bool found = false;
    for (std::int32_t i = first.segment + 1; i <= last.segment; ++i) {
      found = found || view_.bends[chain_.first + wrap(i)] != 0;
    }
    return found;
  }
  /// The smaller one of what SlideView says of two knots: of limits, of allowed and of lengths.
  TRISMOOTH_HOST_DEVICE double limit(std::int32_t i, std::int32_t j) const { return smaller(view_.limits, i, j); }
  TRISMOOTH_HOST_DEVICE double allowed(std::int32_t i, std::int32_t j) const { return smaller(view_.allowed, i, j); }
  TRISMOOTH_HOST_DEVICE double length(std::int32_t i, std::int32_t j) const { return smaller(view_.lengths, i, j); }

  /// Where a place is on a copy. On the polyline a coordinate that is the same at both ends of the segment keeps its
  /// bits, and a place at a knot has those of the knot.
  TRISMOOTH_HOST_DEVICE_CALL Point2<double> position(const SlidePlace& place, std::int32_t copy) const {
    const Point2<double> straight = on_polyline(place, copy);
    if (view_.curve == SlideCurve::polyline) {
      return straight;
    }
    // Hermite's cubic, as what it is beside the polyline.
    const double part = part_of(place);
    const Point2<double> way = knot(place.segment + 1, copy) - knot(place.segment, copy);
    const double length = arc(place.segment + 1) - arc(place.segment);
    const Point2<double> out = slope(place.segment, copy);
    const Point2<double> in = slope(place.segment + 1, copy);
    const double rest = 1 - part;
    const double of_out = part * rest * rest;
    const double of_in = part * part * rest;
    return {straight.x + (of_out * (length * out.x - way.x) - of_in * (length * in.x - way.x)),
            straight.y + (of_out * (length * out.y - way.y) - of_in * (length * in.y - way.y))};
  }

  /// Where the place would be on the polyline.
  TRISMOOTH_HOST_DEVICE Point2<double> on_polyline(const SlidePlace& place, std::int32_t copy) const {
    const double part = part_of(place);
    const Point2<double> from = knot(place.segment, copy);
    const Point2<double> way = knot(place.segment + 1, copy) - from;
    return {from.x + part * way.x, from.y + part * way.y};
  }

  /// The derivative of position() by the arc, on the segment of the place.
  TRISMOOTH_HOST_DEVICE Point2<double> tangent(const SlidePlace& place, std::int32_t copy) const {
    const double length = arc(place.segment + 1) - arc(place.segment);
    const Point2<double> way = knot(place.segment + 1, copy) - knot(place.segment, copy);
    if (view_.curve == SlideCurve::polyline) {
      return {way.x / length, way.y / length};
    }
    const double part = part_of(place);
    const double rest = 1 - part;
    const double of_out = rest * (rest - 2 * part);
    const double of_in = part * (2 * rest - part);
    const Point2<double> out = slope(place.segment, copy);
    const Point2<double> in = slope(place.segment + 1, copy);
    return {(way.x + (of_out * (length * out.x - way.x) - of_in * (length * in.x - way.x))) / length,
            (way.y + (of_out * (length * out.y - way.y) - of_in * (length * in.y - way.y))) / length};
  }

 private:
  TRISMOOTH_HOST_DEVICE std::int32_t wrap(std::int32_t i) const {
    if (!chain_.is_closed) {
      return i;
    }
    const std::int32_t rest = i % chain_.count;
    return rest < 0 ? rest + chain_.count : rest;
  }
  TRISMOOTH_HOST_DEVICE double smaller(const double* values, std::int32_t i, std::int32_t j) const {
    const double first = values[chain_.first + wrap(i)];
    const double second = values[chain_.first + wrap(j)];
    return first < second ? first : second;
  }
  TRISMOOTH_HOST_DEVICE std::int32_t segment_at(std::int32_t i) const {
    return chain_.is_closed || i < chain_.count - 1 ? i : i - 1;
  }
  TRISMOOTH_HOST_DEVICE double part_of(const SlidePlace& place) const {
    const double begin = arc(place.segment);
    return (place.arc - begin) / (arc(place.segment + 1) - begin);
  }

  /// The spline's derivative at a knot: that of the parabola through it and its neighbours (at an end through the next
  /// two), which is the slope of both segments where that is the same.
  TRISMOOTH_HOST_DEVICE_CALL Point2<double> slope(std::int32_t i, std::int32_t copy) const {
    const bool is_begin = !chain_.is_closed && i == 0;
    const bool is_end = !chain_.is_closed && i == chain_.count - 1;
    if ((is_begin || is_end) && chain_.count == 2) {
      return mean_slope(0, copy);
    }
    const std::int32_t middle = is_begin ? i + 1 : (is_end ? i - 1 : i);
    const double before = arc(middle) - arc(middle - 1);
    const double after = arc(middle + 1) - arc(middle);
    const Point2<double> first = mean_slope(middle - 1, copy);
    const Point2<double> second = mean_slope(middle, copy);
    const double turn = is_begin ? -before : (is_end ? before + 2 * after : before);
    const double weight = turn / (before + after);
    return {first.x + weight * (second.x - first.x), first.y + weight * (second.y - first.y)};
  }
  TRISMOOTH_HOST_DEVICE Point2<double> mean_slope(std::int32_t segment, std::int32_t copy) const {
    const double length = arc(segment + 1) - arc(segment);
    const Point2<double> way = knot(segment + 1, copy) - knot(segment, copy);
    return {way.x / length, way.y / length};
  }

  const SlideView& view_;
  const SlideChain& chain_;
};

}  // namespace trismooth

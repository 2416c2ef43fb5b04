// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/slide/slide_curve.h"
#include "trismooth/smoothing/slide/slide_deviation.h"

/// What a method says of a vertex that slides: the same as of a free one, in one variable, the arc. All in double,
/// whatever the precision of the sweeps.
namespace trismooth {

/// Where the sliding vertices are, by knot of the first copies. Those that do not slide are at their own knot.
struct SlidePlaces {
  SlidePlace* places = nullptr;

  TRISMOOTH_HOST_DEVICE SlidePlace& operator[](std::int32_t knot) const { return places[knot]; }
};

/// What the mean-ratio method knows of a fan, as MeanRatioTargets of a free vertex.
struct FanTarget {
  double inverse_area;
  double largest_share;
};

/// Who looks at the elements of a slider: one thread, at one after the other. Others may be several threads that do
/// the same with the same arguments and share this out; take() is called in the order of the elements in any case.
struct SlideAlone {
  /// Calls take(find(i)) for `begin` <= i < `end`.
  template <class Find, class Take>
  TRISMOOTH_HOST_DEVICE void for_each(std::int32_t begin, std::int32_t end, const Find& find, const Take& take) const {
    for (std::int32_t i = begin; i < end; ++i) {
      take(find(i));
    }
  }
};

/// What a vertex that slides does.
struct SlideMove {
  SlidePlace place;
  bool moved;
  double moved_squares;  ///< see MoveLength::moved, of all copies
  double squares;        ///< see MoveLength::sum, of all copies
};

/// One slider and its surroundings. `Points`: points(v) is the position of a packed vertex; `Team`: as SlideAlone.
template <class Points, class Team = SlideAlone>
class SlidingVertex {
 public:
  TRISMOOTH_HOST_DEVICE SlidingVertex(const SlideView& view, const SlidePlaces& places, const Slider& slider,
                                      const Points& points, const Team& team = {})
      : view_(view),
        slider_(slider),
        points_(points),
        team_(team),
        curve_(view, slider.chain),
        own_(places[slider.knot]) {
    const SlideChain& chain = curve_.chain();
    const std::int32_t i = slider.knot - chain.first;
    // The places of a closed chain are counted on from its first knot, which those beyond the seam do not know.
    const auto shifted = [&](std::int32_t knot, std::int32_t rounds) {
      const SlidePlace& place = places[chain.first + knot];
      return SlidePlace{place.arc + static_cast<double>(rounds) * chain.length, place.segment + rounds * chain.count};
    };
    before_ = i > 0 ? shifted(i - 1, 0) : shifted(chain.count - 1, -1);
    after_ = i + 1 < chain.count ? shifted(i + 1, 0) : shifted(0, 1);
  }

  TRISMOOTH_HOST_DEVICE const ChainCurve& curve() const { return curve_; }
  TRISMOOTH_HOST_DEVICE const SlidePlace& own() const { return own_; }
  TRISMOOTH_HOST_DEVICE const SlidePlace& before() const { return before_; }
  TRISMOOTH_HOST_DEVICE const SlidePlace& after() const { return after_; }
  TRISMOOTH_HOST_DEVICE std::int32_t copies() const { return curve_.chain().copies; }
  TRISMOOTH_HOST_DEVICE Point2<double> point(std::int32_t v) const { return points_(v); }

  /// Whether it may be at this place: between its neighbours on the chain, and the line no further from the old one
  /// than it may be.
  TRISMOOTH_HOST_DEVICE bool may_be_at(const SlidePlace& place) const {
    if (!(place.arc > before_.arc && place.arc < after_.arc)) {
      return false;
    }
    if (view_.curve == SlideCurve::polyline && !curve_.bends_between(before_, after_)) {
      return true;
    }
    for (std::int32_t copy = 0; copy < copies(); ++copy) {
      const Point2<double> here = curve_.position(place, copy);
      const double first = deviation_share(curve_, copy, before_, curve_.position(before_, copy), place, here);
      const double second = deviation_share(curve_, copy, place, here, after_, curve_.position(after_, copy));
      if (!(first <= 1 && second <= 1)) {
        return false;
      }
    }
    return true;
  }

  /// The place at `arc`, or if it may not be there the one half as far away, and so on; its own where that becomes
  /// next to nothing. A step that is short to begin with is not worth it, or lines would creep for hundreds of sweeps
  /// (found by experiment: docs/sliding.md).
  TRISMOOTH_HOST_DEVICE_CALL SlidePlace as_far_as_it_may(double arc) const {
    const double gap = after_.arc - before_.arc;
    double step = arc - own_.arc;
    if (!(std::abs(step) > 0x1p-6 * gap)) {
      return own_;
    }
    // Nor is one that no halving brings between the neighbours: where the energy is all but straight it may be so long
    // that the way to its end, round after round of a closed line, has none.
    if (!(std::abs(step) <= 0x1p10 * gap)) {
      return own_;
    }
    for (int tries = 0; tries < most_halvings; ++tries) {
      const SlidePlace place = curve_.at(own_.arc + step, own_.segment);
      if (may_be_at(place)) {
        return place;
      }
      step = 0.5 * step;
      if (!(std::abs(step) > 0x1p-10 * gap)) {
        break;
      }
    }
    return own_;
  }

  /// Calls take(find(copy, position, side)) for all elements of all copies where it is at `place`.
  template <class Find, class Take>
  TRISMOOTH_HOST_DEVICE void for_sides(const SlidePlace& place, const Find& find, const Take& take) const {
    for (std::int32_t copy = 0; copy < copies(); ++copy) {
      const Point2<double> position = curve_.position(place, copy);
      const std::int32_t fan = view_.fan_at[slider_.knot + copy * curve_.chain().count];
      team_.for_each(
          view_.fans[fan], view_.fans[fan + 1], [&](std::int32_t i) { return find(copy, position, view_.sides[i]); },
          take);
    }
  }

  /// What body() returns of the spokes to the other corners of an element, seen from where the vertex is.
  template <class Body>
  TRISMOOTH_HOST_DEVICE auto with_spokes(Point2<double> position, const FanSide& side, const Body& body) const {
    return side.with_corner([&](const auto& corner) {
      return body(corner.with([&](const FanNode& node) { return spoke_to(point(node.vertex), position); }));
    });
  }

  /// The smallest shape quotient of its elements, and how many are inverted.
  TRISMOOTH_HOST_DEVICE double worst_quotient(const SlidePlace& place, int& inverted) const {
    double worst = 1;
    inverted = 0;
    for_sides(
        place,
        [&](std::int32_t /*copy*/, Point2<double> position, const FanSide& side) {
          return with_spokes(position, side, [](const auto& spokes) { return shape_quotient(spokes); });
        },
        [&](double quotient) {
          // A quotient that is no number is the worst.
          worst = quotient >= worst ? worst : quotient;
          inverted += quotient < 0 ? 1 : 0;
        });
    return worst;
  }

  TRISMOOTH_HOST_DEVICE SlideMove stays() const { return {own_, false, 0, 0}; }
  TRISMOOTH_HOST_DEVICE SlideMove moves_to(const SlidePlace& place) const {
    if (place.arc == own_.arc) {
      return stays();
    }
    int neighbours = 0;
    double squares = 0;
    for_sides(
        own_,
        [&](std::int32_t /*copy*/, Point2<double> position, const FanSide& side) {
          return squared_length(point(side.from.vertex) - position);
        },
        [&](double squared) {
          squares += squared;
          ++neighbours;
        });
    const Point2<double> way = curve_.position(place, 0) - curve_.position(own_, 0);
    return {place, true, squared_length(way) * neighbours, squares};
  }

  /// To the place if the worst of its elements gets better there and no more are inverted.
  TRISMOOTH_HOST_DEVICE SlideMove smart_move(const SlidePlace& place) const {
    int inverted_before = 0;
    int inverted_after = 0;
    const double before = worst_quotient(own_, inverted_before);
    const double after = worst_quotient(place, inverted_after);
    return after > before && inverted_after <= inverted_before ? moves_to(place) : stays();
  }

 private:
  static constexpr int most_halvings = 10;

  const SlideView& view_;
  const Slider& slider_;
  const Points& points_;
  Team team_;
  ChainCurve curve_;
  SlidePlace own_;
  SlidePlace before_{};  ///< the neighbours on the chain
  SlidePlace after_{};
};

/// To where the method says that a vertex of a line is to go: in any case, or if the worst of its elements gets better
/// (the paper's rule, section 3.3.4).
template <class Update, class Vertex>
TRISMOOTH_HOST_DEVICE SlideMove slide(const Update& /*method*/, const Vertex& vertex, const FanTarget& /*target*/) {
  const SlidePlace place =
      vertex.as_far_as_it_may(Update::along_line(vertex.before().arc, vertex.own().arc, vertex.after().arc));
  if constexpr (Update::is_smart) {
    return vertex.smart_move(place);
  } else {
    return vertex.moves_to(place);
  }
}

/// The energy of a fan along the chain.
template <class T, bool shaped, bool is_last, class Vertex>
class SlidingEnergy {
 public:
  TRISMOOTH_HOST_DEVICE SlidingEnergy(const MeanRatio<T, shaped, is_last>& method, const Vertex& vertex,
                                      const FanTarget& target)
      : targets_(method.targets()),
        vertex_(vertex),
        target_(target),
        energy_{is_last ? targets_.scales->power : 1, static_cast<double>(targets_.scales->size_weight),
                static_cast<double>(targets_.scales->least_quotient)} {}

  /// Derivatives by the arc.
  struct Slopes {
    double slope = 0;
    double curvature = 0;

    TRISMOOTH_HOST_DEVICE void add(const Slopes& other) {
      slope += other.slope;
      curvature += other.curvature;
    }
  };
  /// The energy with its derivatives, which are two where the place is at a knot.
  struct Expansion {
    double value = 0;
    Slopes back;
    Slopes on;
    bool is_valid = true;
  };

  TRISMOOTH_HOST_DEVICE Expansion expansion(const SlidePlace& place) const {
    Expansion found;
    // Before the knot that the place is at, if it is at one that it can come over.
    const ChainCurve& curve = vertex_.curve();
    const bool at_knot = place.arc == curve.arc(place.segment) && (curve.chain().is_closed || place.segment > 0);
    const SlidePlace back{place.arc, at_knot ? place.segment - 1 : place.segment};
    vertex_.for_sides(
        place,
        [&](std::int32_t copy, Point2<double> position, const FanSide& side) {
          const SideTerms<double, 7> terms =
              of_element(position, side, [this](const auto& element) { return energy_.expansion(element); });
          return Expansion{terms.values[0], along(terms, curve.tangent(back, copy)),
                           along(terms, curve.tangent(place, copy)), terms.margin > 0};
        },
        [&](const Expansion& term) {
          found.value += term.value;
          found.back.add(term.back);
          found.on.add(term.on);
          found.is_valid = found.is_valid && term.is_valid;
        });
    return found;
  }

  /// Whether the energy is smaller than `value` at the place, every element positive and none beyond the growth bound
  /// that was not.
  TRISMOOTH_HOST_DEVICE bool is_better_at(const SlidePlace& place, double value) const {
    double sum = 0;
    bool good = true;
    double largest = 0;
    vertex_.for_sides(
        place,
        [&](std::int32_t /*copy*/, Point2<double> position, const FanSide& side) {
          return of_element(position, side, [this](const auto& element) { return energy_.value(element); });
        },
        [&](const SideTerms<double, 1>& terms) {
          sum += terms.values[0];
          good = good && terms.margin > 0;
          largest = terms.share > largest ? terms.share : largest;
        });
    return good && sum < value && (largest <= target_.largest_share || largest <= largest_share_now());
  }

  TRISMOOTH_HOST_DEVICE int power() const { return energy_.power; }

 private:
  /// The derivatives of an element's terms in one direction.
  static TRISMOOTH_HOST_DEVICE Slopes along(const SideTerms<double, 7>& terms, Point2<double> way) {
    return {
        way.x * terms.values[1] + way.y * terms.values[2],
        (way.x * way.x) * terms.values[3] + (way.y * way.y) * terms.values[5] + 2 * (way.x * way.y) * terms.values[4]};
  }

  TRISMOOTH_HOST_DEVICE double largest_share_now() const {
    double largest = 0;
    vertex_.for_sides(
        vertex_.own(),
        [&](std::int32_t /*copy*/, Point2<double> position, const FanSide& side) {
          return of_element(position, side, [this](const auto& element) { return energy_.value(element).share; });
        },
        [&](double share) { largest = share > largest ? share : largest; });
    return largest;
  }

  /// What the method knows of another corner of an element.
  struct Neighbour {
    Point2<double> position;
    double inverse_area;
  };

  TRISMOOTH_HOST_DEVICE double inverse_area(const FanNode& node) const {
    return node.is_unknown ? target_.inverse_area : static_cast<double>(targets_.inverse_areas[node.vertex]);
  }

  /// What term() returns of an element, as the method sees it from where the vertex is.
  template <class Term>
  TRISMOOTH_HOST_DEVICE auto of_element(Point2<double> position, const FanSide& side, const Term& term) const {
    return side.with_corner([&](const auto& corner) {
      const auto neighbours = corner.with([&](const FanNode& node) {
        return Neighbour{vertex_.point(node.vertex), inverse_area(node)};
      });
      const auto spokes = neighbours.with([&](const Neighbour& of) { return spoke_to(of.position, position); });
      return term(element_of<double>(spokes, side_of<double>(neighbours, target_.inverse_area, metric(corner))));
    });
  }

  template <class Corner>
  TRISMOOTH_HOST_DEVICE auto metric(const Corner& corner) const {
    if constexpr (shaped) {
      EdgeTensor<double> edges;
      corner.for_each([&](const FanNode& node) { edges.add(widened(targets_.edges[node.vertex])); });
      return metric_of(edges);
    } else {
      return EuclideanMetric<double>{};
    }
  }
  static TRISMOOTH_HOST_DEVICE EdgeTensor<double> widened(const EdgeTensor<T>& tensor) {
    return {static_cast<double>(tensor.xx), static_cast<double>(tensor.xy), static_cast<double>(tensor.yy)};
  }

  const MeanRatioTargets<T>& targets_;
  const Vertex& vertex_;
  const FanTarget& target_;
  MeanRatioEnergy<double, is_last ? 0 : 1> energy_;
};

/// One damped Newton step in the arc on the energy of the fan, as MeanRatio makes it in the plane.
template <class T, bool shaped, bool is_last, class Vertex>
TRISMOOTH_HOST_DEVICE SlideMove slide(const MeanRatio<T, shaped, is_last>& method, const Vertex& vertex,
                                      const FanTarget& target) {
  constexpr int most_tries = 4;
  const SlidingEnergy<T, shaped, is_last, Vertex> energy(method, vertex, target);
  const auto at = energy.expansion(vertex.own());
  if (!at.is_valid) {
    return slide(SmartLaplacian{}, vertex, target);
  }
  // At a kink the energy may fall on one side of it alone.
  const bool goes_on = at.on.slope < 0;
  const auto [slope, curvature] = goes_on ? at.on : at.back;
  if (!(goes_on || slope > 0) || !(curvature > 0)) {
    return vertex.stays();
  }
  const double newton = -slope / curvature;
  const double gain = static_cast<double>(energy.power()) * -slope * newton;
  if (!(gain > static_cast<double>(method.step().least_gain) * at.value)) {
    return vertex.stays();
  }
  double length = static_cast<double>(method.step().relaxation);
  for (int tries = 0; tries < most_tries; ++tries) {
    const SlidePlace place = vertex.as_far_as_it_may(vertex.own().arc + length * newton);
    if (place.arc == vertex.own().arc) {
      break;
    }
    if (energy.is_better_at(place, at.value)) {
      return vertex.moves_to(place);
    }
    length = length > 1 ? 1 : 0.5 * length;
  }
  return vertex.stays();
}

}  // namespace trismooth

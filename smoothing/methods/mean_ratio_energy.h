// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/methods/ring_sides.h"

/// The energy that the mean-ratio method makes smaller. T and V as in ring_sides.h.
namespace trismooth {

/// The share that a triangle has in the error of an interpolated gradient, but for the solution's curvature: its area
/// times the square of its size (Ciarlet's estimate). `doubled_area` and the sum of the squared edge lengths.
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V share_of_error(V doubled_area, V squares) {
  return doubled_area * squares;
}
template <class V>
constexpr TRISMOOTH_HOST_DEVICE V share_of_error(const ElementSize<V>& size) {
  return share_of_error(size.doubled_area, size.squares);
}

/// The energy of a triangle:
///
///     alpha^-p + p lambda / 3 (tau + 1 / tau),     tau = area / (area aimed at)
///
/// Of a quadrilateral, with the shape of each corner in place of alpha and half of it as the area:
///
///     sum over the corners of q^-p / 2 + p lambda / 3 (tau + 1 / tau)
///
/// `fixed_power`: p where the code is for this one alone; 0: it is what `power` says. `has_size`: with the term that
/// keeps sizes.
template <class T, int fixed_power, bool has_size = true>
struct MeanRatioEnergy {
  int power;      ///< p
  T size_weight;  ///< lambda / 3
  /// A triangle whose shape quotient is as small as this is as bad as one that is inverted.
  T least_quotient;

  /// The energy.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 1> value(const SideTriangle<V, shaped>& t) const {
    const Terms<V> terms(t);
    return {{of(terms, power_below(terms.ratio))},
            t.doubled_area - least_quotient * t.squares,
            share_of_error(t.doubled_area, t.squares)};
  }

  /// The energy, the derivatives x, y, xx, xy, yy of it divided by p, and the triangle's spoke.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 7> expansion(const SideTriangle<V, shaped>& t) const {
    const Terms<V> terms(t);
    // The derivatives of the area relative to itself: those of 1 / alpha and of tau follow from them.
    const V area_x = -t.c.y * terms.inverse;
    const V area_y = t.c.x * terms.inverse;
    const V scale = T(2 / best_ratio) * terms.inverse;
    const V ratio_x = -scale * t.pull_x - terms.ratio * area_x;
    const V ratio_y = -scale * t.pull_y - terms.ratio * area_y;
    // Their second derivatives. Products of x and y first: a mesh turned by a right angle has the same bits.
    const V ratio_xx = scale * t.stiffness.xx - T(2) * (ratio_x * area_x);
    const V ratio_yy = scale * t.stiffness.yy - T(2) * (ratio_y * area_y);
    V ratio_xy = -(ratio_x * area_y + ratio_y * area_x);
    if constexpr (shaped) {
      ratio_xy += scale * t.stiffness.xy;
    }
    const Power<V> below = power_below(terms.ratio);
    SideTerms<V, 7> result{{of(terms, below), ratio_x, ratio_y, ratio_xx, ratio_xy, ratio_yy, t.spoke},
                           t.doubled_area,
                           share_of_error(t.doubled_area, t.squares)};
    auto& [energy, x, y, xx, xy, yy, spoke] = result.values;
    if constexpr (fixed_power != 1) {
      const V first = below.value;
      const V second = below.slope;
      x = first * ratio_x;
      y = first * ratio_y;
      xx = first * ratio_xx + second * (ratio_x * ratio_x);
      xy = first * ratio_xy + second * (ratio_x * ratio_y);
      yy = first * ratio_yy + second * (ratio_y * ratio_y);
    }
    if constexpr (has_size) {
      // Those of lambda / 3 (tau + 1 / tau).
      const V size_first = size_weight * (terms.tau - terms.inverse_tau);
      const V size_second = T(2) * size_weight * terms.inverse_tau;
      x += size_first * area_x;
      y += size_first * area_y;
      xx += size_second * (area_x * area_x);
      xy += size_second * (area_x * area_y);
      yy += size_second * (area_y * area_y);
    }
    return result;
  }

  /// The energy of a quadrilateral, but for the corner opposite.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 1> value(const SideQuadrilateral<V, shaped>& q) const {
    const V tau = q.doubled_area * q.inverse_area;
    return with_size(q, SideTerms<V, 1>{{twice_power() * (size_weight * (tau + T(1) / tau))}, {}, {}},
                     [](const Shapes& shapes, const auto& corner) { return shapes.value(corner); });
  }

  /// The energy and its derivatives, as those of a triangle.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 7> expansion(const SideQuadrilateral<V, shaped>& q) const {
    const V tau = q.doubled_area * q.inverse_area;
    const V inverse_tau = T(1) / tau;
    const V x = -q.c.y * (inverse_tau * q.inverse_area);
    const V y = q.c.x * (inverse_tau * q.inverse_area);
    const V first = T(2) * size_weight * (tau - inverse_tau);
    const V second = T(4) * size_weight * inverse_tau;
    return with_size(q,
                     SideTerms<V, 7>{{twice_power() * (size_weight * (tau + inverse_tau)), first * x, first * y,
                                      second * (x * x), second * (x * y), second * (y * y), q.spoke},
                                     {},
                                     {}},
                     [](const Shapes& shapes, const auto& corner) { return shapes.expansion(corner); });
  }

 private:
  /// The energy of a corner of a quadrilateral, which has no size of its own.
  using Shapes = MeanRatioEnergy<T, fixed_power, false>;

  /// The sum of squared sides to twice the area of what has the best shape: of a triangle, or of two sides at a corner.
  static constexpr double best_ratio = has_size ? shape_constant : 2;

  constexpr TRISMOOTH_HOST_DEVICE T twice_power() const { return static_cast<T>(2 * power); }

  /// The terms of a quadrilateral, from those of its size twice and those that its corners have of their shapes: half
  /// of all of these.
  template <class V, bool shaped, int count, class TermsOf>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, count> with_size(const SideQuadrilateral<V, shaped>& q,
                                                                SideTerms<V, count> result,
                                                                const TermsOf& terms_of) const {
    constexpr int halved = count < 6 ? count : 6;  // the spoke is that of the quadrilateral
    const Shapes shapes{power, size_weight, least_quotient};
    result.margin = V{} + std::numeric_limits<T>::max();
    result.share = share_of_error(q.doubled_area, q.squares);
    for (const SideTriangle<V, shaped>& corner : q.corners) {
      const SideTerms<V, count> terms = terms_of(shapes, corner);
      for (int i = 0; i < halved; ++i) {
        result.values[i] += terms.values[i];
      }
      result.margin = terms.margin < result.margin ? terms.margin : result.margin;
    }
    for (int i = 0; i < halved; ++i) {
      result.values[i] = T(0.5) * result.values[i];
    }
    return result;
  }

  template <class V>
  struct Terms {
    V tau{};  ///< where it has a size, as inverse_tau
    V inverse_tau{};
    V inverse;  ///< 1 / (twice the area)
    V ratio;    ///< 1 / alpha

    template <bool shaped>
    constexpr TRISMOOTH_HOST_DEVICE explicit Terms(const SideTriangle<V, shaped>& t) {
      // The only division.
      if constexpr (has_size) {
        tau = t.doubled_area * t.inverse_area;
        inverse_tau = T(1) / tau;
        inverse = inverse_tau * t.inverse_area;
      } else {
        inverse = T(1) / t.doubled_area;
      }
      ratio = T(1 / best_ratio) * t.in_metric * inverse;
    }
  };

  /// ratio^(power - 1) and its derivative by the ratio.
  template <class V>
  struct Power {
    V value;
    V slope;
  };
  template <class V>
  constexpr TRISMOOTH_HOST_DEVICE Power<V> power_below(V ratio) const {
    Power<V> result{V{} + T(1), V{}};
    for (int i = 1; i < power && fixed_power != 1; ++i) {
      result.slope = result.slope * ratio + result.value;
      result.value = result.value * ratio;
    }
    return result;
  }

  template <class V>
  constexpr TRISMOOTH_HOST_DEVICE V of(const Terms<V>& terms, const Power<V>& below) const {
    V result = terms.ratio;
    if constexpr (fixed_power != 1) {
      result = below.value * terms.ratio;
    }
    if constexpr (has_size) {
      const V sizes = size_weight * (terms.tau + terms.inverse_tau);
      result += fixed_power == 1 ? sizes : static_cast<T>(power) * sizes;
    }
    return result;
  }
};

}  // namespace trismooth

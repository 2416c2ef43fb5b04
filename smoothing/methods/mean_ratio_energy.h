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
/// `fixed_power`: p where the code is for this one alone; 0: it is what `power` says.
template <class T, int fixed_power>
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
    const V scale = T(2 / shape_constant) * terms.inverse;
    const V ratio_x = -scale * t.pull_x - terms.ratio * area_x;
    const V ratio_y = -scale * t.pull_y - terms.ratio * area_y;
    const V size_first = size_weight * (terms.tau - terms.inverse_tau);
    const V size_second = T(2) * size_weight * terms.inverse_tau;
    // Their second derivatives, and those of lambda / 3 (tau + 1 / tau). Products of x and y first: a mesh turned by a
    // right angle has the same bits.
    const V ratio_xx = scale * t.stiffness.xx - T(2) * (ratio_x * area_x);
    const V ratio_yy = scale * t.stiffness.yy - T(2) * (ratio_y * area_y);
    V ratio_xy = -(ratio_x * area_y + ratio_y * area_x);
    if constexpr (shaped) {
      ratio_xy += scale * t.stiffness.xy;
    }
    const V size_xx = size_second * (area_x * area_x);
    const V size_xy = size_second * (area_x * area_y);
    const V size_yy = size_second * (area_y * area_y);
    if constexpr (fixed_power == 1) {
      return {{of(terms, power_below(terms.ratio)), ratio_x + size_first * area_x, ratio_y + size_first * area_y,
               ratio_xx + size_xx, ratio_xy + size_xy, ratio_yy + size_yy, t.spoke},
              t.doubled_area,
              share_of_error(t.doubled_area, t.squares)};
    } else {
      const Power<V> below = power_below(terms.ratio);
      const V first = below.value;
      const V second = below.slope;
      return {{of(terms, below), first * ratio_x + size_first * area_x, first * ratio_y + size_first * area_y,
               first * ratio_xx + second * (ratio_x * ratio_x) + size_xx,
               first * ratio_xy + second * (ratio_x * ratio_y) + size_xy,
               first * ratio_yy + second * (ratio_y * ratio_y) + size_yy, t.spoke},
              t.doubled_area,
              share_of_error(t.doubled_area, t.squares)};
    }
  }

  /// The energy of a quadrilateral, but for the corner opposite.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 1> value(const SideQuadrilateral<V, shaped>& q) const {
    const V tau = q.doubled_area * q.inverse_area;
    return with_size(q, SideTerms<V, 1>{{static_cast<T>(power) * (size_weight * (tau + T(1) / tau))}, {}, {}},
                     [](const MeanRatioEnergy& shapes, const auto& corner) { return shapes.value(corner); });
  }

  /// The energy and its derivatives, as those of a triangle.
  template <class V, bool shaped>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, 7> expansion(const SideQuadrilateral<V, shaped>& q) const {
    const V tau = q.doubled_area * q.inverse_area;
    const V inverse_tau = T(1) / tau;
    const V x = -q.c.y * (inverse_tau * q.inverse_area);
    const V y = q.c.x * (inverse_tau * q.inverse_area);
    const V first = size_weight * (tau - inverse_tau);
    const V second = T(2) * size_weight * inverse_tau;
    return with_size(q,
                     SideTerms<V, 7>{{static_cast<T>(power) * (size_weight * (tau + inverse_tau)), first * x, first * y,
                                      second * (x * x), second * (x * y), second * (y * y), q.spoke},
                                     {},
                                     {}},
                     [](const MeanRatioEnergy& shapes, const auto& corner) {
                       SideTerms<V, 7> terms = shapes.expansion(corner);
                       terms.values[6] = V{};
                       return terms;
                     });
  }

 private:
  /// The terms of a quadrilateral: those of its size, and those that its corners have of their shapes.
  template <class V, bool shaped, int count, class TermsOf>
  constexpr TRISMOOTH_HOST_DEVICE SideTerms<V, count> with_size(const SideQuadrilateral<V, shaped>& q,
                                                                SideTerms<V, count> result,
                                                                const TermsOf& terms_of) const {
    const MeanRatioEnergy shapes{power, T(0), least_quotient};
    result.margin = V{} + std::numeric_limits<T>::max();
    result.share = share_of_error(q.doubled_area, q.squares);
    for (const SideTriangle<V, shaped>& corner : q.corners) {
      const SideTerms<V, count> terms = terms_of(shapes, corner);
      for (int i = 0; i < count; ++i) {
        result.values[i] += T(0.5) * terms.values[i];
      }
      result.margin = terms.margin < result.margin ? terms.margin : result.margin;
    }
    return result;
  }

  template <class V>
  struct Terms {
    V tau;
    V inverse_tau;
    V inverse;  ///< 1 / (twice the area)
    V ratio;    ///< 1 / alpha

    template <bool shaped>
    constexpr TRISMOOTH_HOST_DEVICE explicit Terms(const SideTriangle<V, shaped>& t)
        : tau(t.doubled_area * t.inverse_area),
          inverse_tau(T(1) / tau),  // the only division
          inverse(inverse_tau * t.inverse_area),
          ratio(T(1 / shape_constant) * t.in_metric * inverse) {}
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
    const V sizes = size_weight * (terms.tau + terms.inverse_tau);
    if constexpr (fixed_power == 1) {
      return terms.ratio + sizes;
    } else {
      return below.value * terms.ratio + static_cast<T>(power) * sizes;
    }
  }
};

}  // namespace trismooth

#pragma once

#include <cstdint>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"

namespace trismooth {

/// What the mean-ratio method makes of the mesh as a whole.
template <class T>
struct MeanRatioScales {
  T size_weight = 0;  ///< lambda / 3
  int power = 2;      ///< of the inverse mean ratio, in the last stage
};

/// What it knows of the mesh as it was before the first sweep (see mean_ratio_targets.h), by packed vertex. Somebody
/// else owns it.
template <class T>
struct MeanRatioTargets {
  /// 1 / (twice the area to be aimed at) around a vertex.
  const T* inverse_areas = nullptr;
  /// The growth bound: the largest share_of_error() that a move may give a triangle around a free vertex.
  const T* largest_shares = nullptr;
  const MeanRatioScales<T>* scales = nullptr;
  /// x and y of every vertex where triangles have the shapes to be aimed at; null: all are equilateral.
  const T* reference = nullptr;
};

/// What the method does in a stage of the smoothing.
template <class T>
struct MeanRatioStep {
  T relaxation = 1;     ///< the first step tried, in Newton steps
  T least_gain = 0;     ///< of a step, relative to the energy, as Newton's model foretells it: less is not worth a move
  bool is_last = true;  ///< the power is that of MeanRatioScales, else 1
};

/// The share that a triangle has in the error of an interpolated gradient, but for the solution's curvature: its area
/// times the square of its size (Ciarlet's estimate). `doubled_area` and the sum of the squared edge lengths.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T share_of_error(T doubled_area, T squares) {
  return doubled_area * squares;
}

/// Smoothing by an energy of the elements: Munson's inverse mean ratio (T. Munson 2007, "Mesh shape-quality
/// optimization using the inverse mean-ratio metric"), which is 1 / alpha, with a term that keeps sizes. The energy of
/// a vertex is the sum over its triangles of
///
///     alpha^-p + p lambda / 3 (tau + 1 / tau),     tau = area / (area aimed at)
///
/// Each term is convex where the triangle is positive, so a ring has one minimum. A visit makes one Newton step with
/// the 2 x 2 Hessian in closed form: over-relaxed first, then Newton's own, then halves of it, until the energy is
/// smaller, every triangle positive, and none has grown beyond the growth bound. Where a triangle of the ring is
/// inverted or degenerate there is no energy; the smart Laplacian rule moves the vertex then.
///
/// Only + - * / in a fixed order: the same bits everywhere. `shaped`: with reference shapes, else alpha is the shape.
template <class T, bool shaped>
class MeanRatio {
 public:
  constexpr TRISMOOTH_HOST_DEVICE MeanRatio(const MeanRatioTargets<T>& targets, const MeanRatioStep<T>& step)
      : targets_(targets), step_(step) {}

  /// ring.number(i): the packed number of neighbour i.
  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE Move<T> update(std::int32_t v, Point2<T> position, const Ring& ring) const {
    const MeanRatioScales<T> scales = *targets_.scales;
    const Energy energy{step_.is_last ? scales.power : 1, scales.size_weight};
    Expansion at{};
    bool positive = true;
    for_triangles(v, position, ring, [&](const Triangle& t) {
      positive &= t.doubled_area > T(0);
      at.add(t, energy);
    });
    if (!positive) {
      return SmartLaplacian::update(position, ring);
    }
    const T inverse = T(1) / (at.xx * at.yy - at.xy * at.xy);
    const Point2<T> newton{inverse * (at.xy * at.y - at.yy * at.x), inverse * (at.xy * at.x - at.xx * at.y)};
    // Half of this is what a Newton step gains where the energy is quadratic. (The expansion is that of the energy
    // divided by the power.)
    const T gain = -static_cast<T>(energy.power) * (newton.x * at.x + newton.y * at.y);
    if (!(inverse > T(0)) || !(gain > step_.least_gain * at.energy)) {
      return stay(position);
    }
    T length = step_.relaxation;
    for (int tries = 0; tries < most_tries; ++tries) {
      const Point2<T> target{position.x + length * newton.x, position.y + length * newton.y};
      if (is_accepted(v, position, target, ring, at.energy, energy)) {
        return move_to(position, target);
      }
      length = length > T(1) ? T(1) : length * T(0.5);
    }
    return stay(position);
  }

 private:
  static constexpr int most_tries = 4;

  /// A triangle (v, a, b) seen from v.
  struct Triangle {
    Point2<T> c;  ///< from a to b
    T doubled_area;
    T squares;  ///< of the edges, weighted by the shape that is aimed at
    T pull_x;   ///< of v on that sum: minus half its derivative
    T pull_y;
    T stiffness;     ///< half its second derivative
    T share;         ///< share_of_error()
    T inverse_area;  ///< 1 / (twice the area that is aimed at)

    /// The terms of the energy and of its derivatives: 1 / (twice the area), 1 / alpha, tau and 1 / tau.
    struct Terms {
      T inverse;
      T ratio;
      T tau;
      T inverse_tau;
    };
    constexpr TRISMOOTH_HOST_DEVICE Terms terms() const {
      const T tau = doubled_area * inverse_area;
      const T inverse_tau = T(1) / tau;  // the only division
      const T inverse = inverse_tau * inverse_area;
      return {inverse, T(1 / shape_constant) * squares * inverse, tau, inverse_tau};
    }
  };

  /// ratio^(power - 1) and its derivative by the ratio.
  struct Power {
    T value;
    T slope;
  };
  static constexpr TRISMOOTH_HOST_DEVICE Power power_below(T ratio, int power) {
    Power result{1, 0};
    for (int i = 1; i < power; ++i) {
      result.slope = result.slope * ratio + result.value;
      result.value = result.value * ratio;
    }
    return result;
  }

  /// The energy's parameters.
  struct Energy {
    int power;
    T size_weight;

    constexpr TRISMOOTH_HOST_DEVICE T of(const typename Triangle::Terms& terms, const Power& below) const {
      return below.value * terms.ratio + static_cast<T>(power) * size_weight * (terms.tau + terms.inverse_tau);
    }
  };

  /// The energy around a vertex, and the first and second derivatives of its part by the power.
  struct Expansion {
    T energy;
    T x;
    T y;
    T xx;
    T xy;
    T yy;

    constexpr TRISMOOTH_HOST_DEVICE void add(const Triangle& t, const Energy& of) {
      const typename Triangle::Terms terms = t.terms();
      // The derivatives of the area relative to itself: those of 1 / alpha and of tau follow from them.
      const T area_x = -t.c.y * terms.inverse;
      const T area_y = t.c.x * terms.inverse;
      const T scale = T(2 / shape_constant) * terms.inverse;
      const T ratio_x = -scale * t.pull_x - terms.ratio * area_x;
      const T ratio_y = -scale * t.pull_y - terms.ratio * area_y;
      const T curvature = scale * t.stiffness;
      const T ratio_xx = curvature - T(2) * ratio_x * area_x;
      const T ratio_yy = curvature - T(2) * ratio_y * area_y;
      const T ratio_xy = -(ratio_x * area_y + ratio_y * area_x);
      const Power below = power_below(terms.ratio, of.power);
      const T first = below.value;
      const T second = below.slope;
      const T size_first = of.size_weight * (terms.tau - terms.inverse_tau);
      const T size_second = T(2) * of.size_weight * terms.inverse_tau;
      energy += of.of(terms, below);
      x += first * ratio_x + size_first * area_x;
      y += first * ratio_y + size_first * area_y;
      xx += first * ratio_xx + second * ratio_x * ratio_x + size_second * area_x * area_x;
      // Products of x and y first: a mesh turned by a right angle has the same bits.
      xy += first * ratio_xy + second * (ratio_x * ratio_y) + size_second * (area_x * area_y);
      yy += first * ratio_yy + second * ratio_y * ratio_y + size_second * area_y * area_y;
    }
  };

  /// The weights of the squared edges in the mean ratio to a reference triangle, whose cotangents they are (times
  /// sqrt(3), so that they are 1 where it is equilateral); 1 where it is inverted or degenerate.
  struct EdgeWeights {
    T a = 1;
    T b = 1;
    T c = 1;
  };
  constexpr TRISMOOTH_HOST_DEVICE Point2<T> reference(std::int32_t v) const {
    const T* const xy = targets_.reference + 2 * static_cast<std::int64_t>(v);
    return {xy[0], xy[1]};
  }
  constexpr TRISMOOTH_HOST_DEVICE EdgeWeights reference_weights(std::int32_t v, std::int32_t na,
                                                                std::int32_t nb) const {
    const Point2<T> a = reference(na) - reference(v);
    const Point2<T> b = reference(nb) - reference(v);
    const Point2<T> c = b - a;
    const T area = cross(a, b);
    if (!(area > T(0))) {
      return {};
    }
    const T scale = T(shape_constant / 2) / area;
    return {scale * (b.x * c.x + b.y * c.y), scale * -(a.x * c.x + a.y * c.y), scale * (a.x * b.x + a.y * b.y)};
  }

  /// What is read of a neighbour.
  struct Neighbour {
    std::int32_t number;
    Point2<T> position;
    T inverse_area;
  };
  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE Neighbour fetched(const Ring& ring, int i) const {
    const std::int32_t number = ring.number(i);
    return {number, ring[i], targets_.inverse_areas[number]};
  }

  /// Calls visit(a, b) with the neighbours at the ends of each side of a ring. Each is fetched while the side before
  /// its own is worked on: a device waits long for its memory.
  template <class Ring, class Visit>
  constexpr TRISMOOTH_HOST_DEVICE void for_sides(const Ring& ring, const Visit& visit) const {
    const Neighbour first = fetched(ring, 0);
    Neighbour from = first;
    Neighbour to = fetched(ring, 1);
    for (int i = 2; i <= ring.size(); ++i) {
      const Neighbour following = i < ring.size() ? fetched(ring, i) : first;
      visit(from, to);
      from = to;
      to = following;
    }
    visit(from, to);
  }

  /// Calls visit(triangle) for the triangles of v as they are where v is at `position`.
  template <class Ring, class Visit>
  constexpr TRISMOOTH_HOST_DEVICE void for_triangles(std::int32_t v, Point2<T> position, const Ring& ring,
                                                     const Visit& visit) const {
    const T own = targets_.inverse_areas[v];
    for_sides(ring, [&](const Neighbour& from, const Neighbour& to) {
      const Point2<T> a = from.position - position;
      const Point2<T> b = to.position - position;
      const Point2<T> c = to.position - from.position;
      const T area = cross(a, b);
      const T squares = squared_length(a) + squared_length(b) + squared_length(c);
      Triangle triangle{c,
                        area,
                        squares,
                        a.x + b.x,
                        a.y + b.y,
                        T(2),
                        share_of_error(area, squares),
                        T(1) / T(3) * (own + from.inverse_area + to.inverse_area)};
      if constexpr (shaped) {
        const EdgeWeights weights = reference_weights(v, from.number, to.number);
        triangle.squares =
            weights.a * squared_length(a) + weights.b * squared_length(b) + weights.c * squared_length(c);
        triangle.pull_x = weights.a * a.x + weights.b * b.x;
        triangle.pull_y = weights.a * a.y + weights.b * b.y;
        triangle.stiffness = weights.a + weights.b;
      }
      visit(triangle);
    });
  }

  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE bool is_accepted(std::int32_t v, Point2<T> position, Point2<T> target,
                                                   const Ring& ring, T energy_before, const Energy& energy) const {
    const T largest = targets_.largest_shares[v];
    T after = 0;
    bool positive = true;
    bool grows = false;
    for_triangles(v, target, ring, [&](const Triangle& t) {
      const typename Triangle::Terms terms = t.terms();
      positive &= t.doubled_area > T(0);
      grows |= t.share > largest;
      after += energy.of(terms, power_below(terms.ratio, energy.power));
    });
    return positive & (after < energy_before) && !(grows && grows_beyond(largest, position, target, ring));
  }

  /// Whether a triangle whose share is above the bound would get a larger one than it has.
  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE bool grows_beyond(T largest, Point2<T> position, Point2<T> target,
                                                    const Ring& ring) const {
    bool grows = false;
    for_sides(ring, [&](const Neighbour& from, const Neighbour& to) {
      const T now = share_at(target, from.position, to.position);
      grows |= now > largest && now > share_at(position, from.position, to.position);
    });
    return grows;
  }
  static constexpr TRISMOOTH_HOST_DEVICE T share_at(Point2<T> v, Point2<T> a, Point2<T> b) {
    return share_of_error(cross(a - v, b - v), squared_length(a - v) + squared_length(b - v) + squared_length(b - a));
  }

  MeanRatioTargets<T> targets_;
  MeanRatioStep<T> step_;
};

}  // namespace trismooth

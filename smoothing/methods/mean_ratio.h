// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/smoothing/methods/mean_ratio_energy.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/ring_sides.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"

namespace trismooth {

/// What the mean-ratio method makes of the mesh as a whole.
template <class T>
struct MeanRatioScales {
  T size_weight = 0;  ///< lambda / 3
  int power = 2;      ///< of the inverse mean ratio, in the last stage
  /// No move may leave a triangle with a shape quotient as small as this.
  T least_quotient = 0;
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
  /// The sum over the edges around every vertex, whose shape is to be kept; all zeros where nothing is known of it.
  /// Null: equilateral.
  const EdgeTensor<T>* edges = nullptr;
};

/// What the method does in a stage of the smoothing.
template <class T>
struct MeanRatioStep {
  T relaxation = 1;     ///< the first step tried, in Newton steps
  T least_gain = 0;     ///< of a step, relative to the energy, as Newton's model foretells it: less is not worth a move
  bool is_last = true;  ///< the power is that of MeanRatioScales, else 1
  bool is_soft = false;  ///< steps are cut short by the part of least_gain in their gain: nothing jumps where that ends
};

/// A move by the energy, or several in lanes. V: a number, or lanes of it.
template <class V>
struct NewtonMove {
  using Mask = decltype(V{} < V{});

  Point2<V> target;  ///< where it moves
  V squares;         ///< see VertexMove
  Mask is_valid;     ///< every triangle is positive; there is no energy elsewhere
  Mask moved;
};

/// Smoothing by an energy of the elements: Munson's inverse mean ratio (T. Munson 2007, "Mesh shape-quality
/// optimization using the inverse mean-ratio metric"), which is 1 / alpha, with a term that keeps sizes. The energy of
/// a vertex is the sum of MeanRatioEnergy over its triangles.
///
/// Each term is convex where the triangle is positive, so a ring has one minimum. A visit makes one Newton step with
/// the 2 x 2 Hessian in closed form: over-relaxed first, then Newton's own, then halves of it, until the energy is
/// smaller, every triangle positive, and none has grown beyond the growth bound. Where a triangle of the ring is
/// inverted or degenerate there is no energy; the smart Laplacian rule moves the vertex then.
///
/// Only + - * / and square roots in a fixed order: the same bits everywhere. `shaped`: with a metric of its own for
/// each triangle, else alpha is the shape. `is_last`: in the last stage; before, the power is 1.
template <class T, bool shaped, bool is_last>
class MeanRatio {
 public:
  static constexpr bool moves_nearly_all = !is_last;

  /// That of a side. V: see NewtonMove.
  template <class V>
  using Metric = std::conditional_t<shaped, EdgeTensor<V>, EuclideanMetric<V>>;

  constexpr TRISMOOTH_HOST_DEVICE MeanRatio(const MeanRatioTargets<T>& targets, const MeanRatioStep<T>& step)
      : targets_(targets), step_(step) {}

  /// ring.number(i): the packed number of neighbour i.
  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE Move<T> update(std::int32_t v, Point2<T> position, const Ring& ring) const {
    return vertex_move(v, position, ring).move;
  }

  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE VertexMove<T> vertex_move(std::int32_t v, Point2<T> position,
                                                            const Ring& ring) const {
    const T own = targets_.inverse_areas[v];
    const T largest = targets_.largest_shares[v];
    const auto fetch = [&](int i) -> Neighbour {
      const std::int32_t number = ring.number(i);
      return {ring[i], targets_.inverse_areas[number], number};
    };
    const auto side = [&](const auto& corner) {
      return side_of<T>(corner, own, metric(v, corner.with([](const Neighbour& of) { return of.number; })));
    };
    const auto grows = [&](bool is_candidate, Point2<T> target) {
      return is_candidate && grows_beyond(largest, position, target, ring);
    };
    const NewtonMove<T> found = newton_move(sides_in_turn<T>(ring, fetch, side), position, largest, grows);
    if (!found.is_valid) {
      return with_squares(SmartLaplacian::update(position, ring), position, ring);
    }
    return {found.moved ? move_to(position, found.target) : stay(position), found.squares};
  }

  /// The move of a vertex by the energy, or of several at once. `largest`: of largest_shares. Where a step is a
  /// candidate but gives a triangle a share above that, grows(candidates, target) says which of them may not be.
  template <class V, class Sides, class Grows>
  constexpr TRISMOOTH_HOST_DEVICE NewtonMove<V> newton_move(const Sides& sides, Point2<V> position, V largest,
                                                            const Grows& grows) const {
    using Mask = typename NewtonMove<V>::Mask;
    const MeanRatioScales<T> scales = *targets_.scales;
    const MeanRatioEnergy<T, is_last ? 0 : 1> energy{is_last ? scales.power : 1, scales.size_weight,
                                                     scales.least_quotient};
    const auto at =
        sides.template totals<7>(position, [&](const auto& triangle) { return energy.expansion(triangle); });
    const auto [value, x, y, xx, xy, yy, squares] = at.sums;
    const V inverse = T(1) / (xx * yy - xy * xy);
    Point2<V> newton{inverse * (xy * y - yy * x), inverse * (xy * x - xx * y)};
    // Half of this is what a Newton step gains where the energy is quadratic. (The expansion is that of the energy
    // divided by the power.)
    const V gain = -static_cast<T>(energy.power) * (newton.x * x + newton.y * y);

    NewtonMove<V> result{position, squares, at.smallest_margin > T(0), Mask{}};
    Mask open = result.is_valid && inverse > T(0) && gain > step_.least_gain * value;
    if (step_.is_soft) {
      const V part = T(1) - step_.least_gain * value / gain;
      newton = {part * newton.x, part * newton.y};
    }
    T length = step_.relaxation;
    for (int tries = 0; tries < most_tries && sides.any(open); ++tries) {
      const Point2<V> target{position.x + length * newton.x, position.y + length * newton.y};
      const auto after = sides.template totals<1>(target, [&](const auto& triangle) { return energy.value(triangle); });
      Mask good = open && after.smallest_margin > T(0) && after.sums[0] < value;
      good = good && !grows(good && after.largest_share > largest, target);
      result.target = {good ? target.x : result.target.x, good ? target.y : result.target.y};
      result.moved = result.moved || good;
      open = open && !good;
      length = length > T(1) ? T(1) : length * T(0.5);
    }
    return result;
  }

  constexpr TRISMOOTH_HOST_DEVICE const MeanRatioTargets<T>& targets() const { return targets_; }
  constexpr TRISMOOTH_HOST_DEVICE const MeanRatioStep<T>& step() const { return step_; }

  /// The metric to be aimed at in an element around a vertex, of determinant 1: that of the edges around its free
  /// corners; Euclid's where nothing is known of these. The corner is of numbers.
  template <class Corner>
  constexpr TRISMOOTH_HOST_DEVICE Metric<T> metric(std::int32_t v, const Corner& corner) const {
    if constexpr (shaped) {
      EdgeTensor<T> edges = targets_.edges[v];
      corner.for_each([&](std::int32_t neighbour) { edges.add(targets_.edges[neighbour]); });
      return metric_of(edges);
    } else {
      return {};
    }
  }

 private:
  static constexpr int most_tries = 4;

  /// What is read of a neighbour.
  struct Neighbour {
    Point2<T> position;
    T inverse_area;
    std::int32_t number;
  };

  /// Whether a triangle whose share is above the bound would get a larger one than it has.
  template <class Ring>
  constexpr TRISMOOTH_HOST_DEVICE bool grows_beyond(T largest, Point2<T> position, Point2<T> target,
                                                    const Ring& ring) const {
    bool grows = false;
    for_elements_around(ring, [&](const auto& corner) {
      const auto share_at = [&](Point2<T> vertex) {
        return share_of_error(size_of(corner.with([&](Point2<T> end) { return spoke_to(end, vertex); })));
      };
      const T now = share_at(target);
      grows |= now > largest && now > share_at(position);
    });
    return grows;
  }

  MeanRatioTargets<T> targets_;
  MeanRatioStep<T> step_;
};

template <>
struct UpdateOf<Method::mean_ratio> {
  template <class MethodInUse, class Function>
  static decltype(auto) visit(const MethodInUse& in_use, Function&& function) {
    return in_use.targets.edges != nullptr ? visit_shaped<true>(in_use.targets, in_use.step, function)
                                           : visit_shaped<false>(in_use.targets, in_use.step, function);
  }

 private:
  template <bool shaped, class T, class Function>
  static decltype(auto) visit_shaped(const MeanRatioTargets<T>& targets, const MeanRatioStep<T>& step,
                                     const Function& function) {
    return step.is_last ? function(MeanRatio<T, shaped, true>(targets, step))
                        : function(MeanRatio<T, shaped, false>(targets, step));
  }
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/ring_elements.h"

/// Decides most smart moves of vertices of quadrilaterals with one division an element in place of seven: these take
/// longer than all the rest. (That of the GPU, cuda/update/quotient_filter.cuh, divides approximately; an instruction
/// for that is not to be had for doubles here.)
///
/// A corner's shape is the rounded 2 a / s, where a is the area and s the sum of the squares in corner_shape(); a and s
/// are the very same rounded numbers here, but for the sign of a zero. With u the unit roundoff |a / s| is at most
/// 1 / 2 + 3 u, and an element's quotient is the smallest of its corners' shapes times a constant: two roundings. Where
/// a / s is larger by more than 2.2 u, so is the quotient.
///   The smallest a / s before, t, is that of three corners of each element: the smallest of a1 (s2 s3), a2 (s1 s3) and
///     a3 (s1 s2), divided by s1 s2 s3. Off by at most 5 u relative, so by 2.6 u.
///   The gain at a corner afterwards is a - t s. Rounding puts it off by at most 1.6 u s.
/// Together the order is certain where a gain is further from 0 than 6.4 u s. The band is more than twice as wide, and
/// one for all corners, by the sum of all squared lengths, which is at least each s.
///
/// The corner opposite of the vertex is the same before and afterwards. It is looked at afterwards alone: if it is the
/// smallest of all before, it is no better than that afterwards, and says so by its gain.
///
/// What overflows or is no number shows in the sum of the squared lengths. Nothing may underflow in t: where s1 s2 s3
/// is above `least_product` and no s above `most_squares`, products of two are normal numbers, too, and what is lost of
/// a product with a is nothing beside u. The largest s is above 2^-340 then, so the band is far from underflow.
///
/// Of doubles alone. In single precision a sixth of the vertices of a grid that is nearly smooth gain less than the
/// band, most registers would compute everything as well, and dividing takes half as long.
namespace trismooth::quotient_filter {

inline constexpr double band = 0x1p-49;  ///< 16 u
inline constexpr double most_squares = 0x1p6;
inline constexpr double least_product = 0x1p-1000;

/// Above `band`, every quotient around the target is larger than the smallest one around the position, which is not
/// negative; below -band, one of them is not. Nothing is known between.
struct Gain {
  double gain;
  double band;
};

/// A quadrilateral, seen from a place of its vertex: twice the area of the triangle at each corner, and the sum of the
/// squares of its sides there.
struct Corners {
  struct Corner {
    double area;
    double sum;
  };
  Corner own, next, opposite, previous;
};

[[gnu::always_inline]] inline Corners corners_of(const QuadrilateralCorner<RingSpoke<double>>& corner) {
  const auto& [a, o, b] = corner;
  const Point2<double> from_next = o.end - a.end;
  const Point2<double> to_previous = b.end - o.end;
  const double from2 = squared_length(from_next);
  const double to2 = squared_length(to_previous);
  return {{cross(a.edge, b.edge), a.squared + b.squared},
          {cross(a.edge, from_next), a.squared + from2},
          {cross(from_next, to_previous), from2 + to2},
          {cross(b.edge, to_previous), b.squared + to2}};
}

/// Of a vertex in quadrilaterals alone. (Everything is inlined by force: GCC makes vectors of loops over lanes of it.)
template <MixedRing Ring>
[[gnu::always_inline]] inline Gain gain(Point2<double> position, Point2<double> target, const Ring& ring) {
  using Spokes = QuadrilateralCorner<RingSpoke<double>>;
  const auto smaller = [](double a, double b) __attribute__((always_inline)) {
    return b < a ? b : a;
  };
  double before = 1;
  double product_before = 1;
  double squares = 0;
  const auto add_before = [&](const Spokes& spokes) __attribute__((always_inline)) {
    const auto [own, next, opposite, previous] = corners_of(spokes);
    const double of_others = next.sum * previous.sum;
    const double product = own.sum * of_others;
    const double others = smaller(next.area * (own.sum * previous.sum), previous.area * (own.sum * next.sum));
    before = smaller(before, smaller(own.area * of_others, others) / product);
    product_before = smaller(product_before, product);
    squares += own.sum + opposite.sum;
  };
  for_elements_around(
      ring, [&](int i) { return spoke_to<double>(ring[i], position); }, add_before);
  double gain = std::numeric_limits<double>::max();
  const auto add_after = [&](const Spokes& spokes) __attribute__((always_inline)) {
    const auto [own, next, opposite, previous] = corners_of(spokes);
    const double one = smaller(own.area - before * own.sum, opposite.area - before * opposite.sum);
    const double other = smaller(next.area - before * next.sum, previous.area - before * previous.sum);
    gain = smaller(gain, smaller(one, other));
    squares += own.sum;
  };
  for_elements_around(
      ring, [&](int i) { return spoke_to<double>(ring[i], target); }, add_after);
  const bool is_sound = (squares < most_squares) & (product_before > least_product) & (before > 0);
  return {is_sound ? gain : 0, band * squares};
}

}  // namespace trismooth::quotient_filter

#pragma once

#include <cmath>
#include <cstdint>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// A triangle at least four times as long as high, as the search for layers knows it. Its *aspect* is the root of the
/// ratio of the eigenvalues of its edge tensor, the sum of e e^T over its edges e: 1 for an equilateral triangle. It is
/// a function of the shape alone: of the tensor with trace 1 the determinant is shape^2 / 4, so an aspect of 4 is a
/// shape of 8 / 17, and what is written here needs no eigenvalues, roots or angles.
///
/// All of it is computed from the corners in the order in which they are listed, in the local frame, by + - x and /,
/// with the same bits on host and device.
struct FlatTriangle {
  /// How large its largest angle is.
  enum class Angle : std::uint32_t { moderate, wide, obtuse };  ///< below 110 degrees, up to 135, above that

  Triangle corners;  ///< in whatever numbering
  Angle angle;
  double xx;        ///< of its edge tensor with trace 1; yy is 1 - xx
  double xy;        ///< likewise
  double quotient;  ///< cross product / sum of the squared edges: shape / (2 sqrt(3)), as the corners are listed
};

namespace flat_triangle_details {

/// The edges at the first corner and the third edge.
struct Edges {
  Point2<double> ab, ac, bc;
};

TRISMOOTH_HOST_DEVICE inline double sum_of_squares(const Edges& e) {
  return squared_length(e.ab) + squared_length(e.bc) + squared_length(e.ac);
}

}  // namespace flat_triangle_details

/// Whether the triangle (a, b, c) has an aspect of 4 or more, and an area: where there is none, nothing is on purpose.
TRISMOOTH_HOST_DEVICE inline bool is_flat(Point2<double> a, Point2<double> b, Point2<double> c) {
  const flat_triangle_details::Edges e = {b - a, c - a, c - b};
  const double sum = flat_triangle_details::sum_of_squares(e);
  const double twice_area = cross(e.ab, e.ac);
  // 12 (C / D)^2 <= (8 / 17)^2
  return twice_area != 0 && 867 * (twice_area * twice_area) <= 16 * (sum * sum);
}

/// Whether it is flat and turned as its component is, `is_reversed` being what MeshRings::reversed says of it: what is
/// inverted is no layer.
TRISMOOTH_HOST_DEVICE inline bool is_flat_and_valid(Point2<double> a, Point2<double> b, Point2<double> c,
                                                    bool is_reversed) {
  return is_flat(a, b, c) && (cross(b - a, c - a) > 0) != is_reversed;
}

/// What is to be known of a flat triangle.
TRISMOOTH_HOST_DEVICE inline FlatTriangle described_flat(const Triangle& corners, Point2<double> a, Point2<double> b,
                                                         Point2<double> c) {
  const flat_triangle_details::Edges e = {b - a, c - a, c - b};
  const double squares[3] = {squared_length(e.ab), squared_length(e.bc), squared_length(e.ac)};
  const double sum = flat_triangle_details::sum_of_squares(e);
  const int longest = squares[1] > squares[0] ? (squares[2] > squares[1] ? 2 : 1) : (squares[2] > squares[0] ? 2 : 0);
  const double m = squares[(longest + 1) % 3];
  const double n = squares[(longest + 2) % 3];
  // The law of cosines: excess = -2 sqrt(m n) cos(angle).
  const double excess = squares[longest] - m - n;
  constexpr double square_of_cosine_110 = 0.11697777844051098;
  FlatTriangle flat{corners, FlatTriangle::Angle::moderate, 0, 0, 0};
  if (excess > 0 && excess * excess > 2 * (m * n)) {
    flat.angle = FlatTriangle::Angle::obtuse;
  } else if (excess > 0 && excess * excess >= 4 * square_of_cosine_110 * (m * n)) {
    flat.angle = FlatTriangle::Angle::wide;
  }
  flat.xx = (e.ab.x * e.ab.x + e.bc.x * e.bc.x + e.ac.x * e.ac.x) / sum;
  flat.xy = (e.ab.x * e.ab.y + e.bc.x * e.bc.y + e.ac.x * e.ac.y) / sum;
  flat.quotient = cross(e.ab, e.ac) / sum;
  return flat;
}

/// Whether two of them are flat in one direction: the mean of their edge tensors has an aspect of 4 or more.
TRISMOOTH_HOST_DEVICE inline bool are_coherent(const FlatTriangle& one, const FlatTriangle& other) {
  const double xx = (one.xx + other.xx) / 2;
  const double xy = (one.xy + other.xy) / 2;
  return 289 * (xx * (1 - xx) - xy * xy) <= 16;
}

/// The aspect of a flat triangle of this quotient.
inline double aspect_of(double quotient) {
  const double square = 12 * quotient * quotient;
  return (1 + std::sqrt(square < 1 ? 1 - square : 0)) / std::sqrt(square);
}

}  // namespace trismooth

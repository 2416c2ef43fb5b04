// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

/// A triangle at least four times as long as high, as the search for layers knows it. Its *aspect* is the root of the
/// ratio of the eigenvalues of its edge tensor, the sum of e e^T over its edges e: 1 for an equilateral triangle. It is
/// a function of the shape alone: of the tensor with trace 1 the determinant is shape^2 / 4, so an aspect of 4 is a
/// shape of 8 / 17, and what is written here needs no eigenvalues, roots or angles.
///
/// All of it is computed from the corners in canonical order, in the local frame, by + - x and /, with the same bits on
/// host and device and however the file lists the triangle.
struct FlatTriangle {
  /// How large its largest angle is.
  enum class Angle : std::uint32_t { moderate, wide, obtuse };  ///< below 110 degrees, up to 135, above that

  Triangle corners;  ///< in whatever numbering
  Angle angle;
  double xx;        ///< of its edge tensor with trace 1; yy is 1 - xx
  double xy;        ///< of that tensor
  double quotient;  ///< shape_quotient(), above 0
};

/// Whether the triangle with these canonical corners has an aspect of 4 or more. Where it has no area, or is inverted,
/// nothing is on purpose.
constexpr TRISMOOTH_HOST_DEVICE bool is_flat(Point2<double> a, Point2<double> b, Point2<double> c) {
  const double quotient = shape_quotient(a, b, c);
  // (2 sqrt(3) quotient)^2 <= (8 / 17)^2
  return quotient > 0 && 867 * (quotient * quotient) <= 16;
}

/// The edge tensor of a triangle with trace 1, without its yy.
struct FlatTensor {
  double xx;
  double xy;
};

TRISMOOTH_HOST_DEVICE inline FlatTensor flat_tensor(Point2<double> a, Point2<double> b, Point2<double> c) {
  const Point2<double> ab = b - a;
  const Point2<double> bc = c - b;
  const Point2<double> ac = c - a;
  const double sum = squared_length(ab) + squared_length(bc) + squared_length(ac);
  return {(ab.x * ab.x + bc.x * bc.x + ac.x * ac.x) / sum, (ab.x * ab.y + bc.x * bc.y + ac.x * ac.y) / sum};
}

/// A tensor in 1024ths, for sums that do not depend on their order; negative numbers by their complement. (Sums of
/// millions run over, everywhere alike.)
struct TensorUnits {
  std::uint32_t xx;
  std::uint32_t xy;
};

TRISMOOTH_HOST_DEVICE inline TensorUnits in_units(const FlatTensor& tensor) {
  return {static_cast<std::uint32_t>(static_cast<std::int32_t>(1024 * tensor.xx)),
          static_cast<std::uint32_t>(static_cast<std::int32_t>(1024 * tensor.xy))};
}

/// The flat triangles around a vertex.
struct FlatAround {
  std::uint32_t count = 0;
  TensorUnits sum{};

  /// Whether the mean of their tensors has an aspect of 3 or more.
  TRISMOOTH_HOST_DEVICE bool is_coherent() const {
    const double units = 1024.0 * count;
    const double xx = sum.xx / units;
    const double xy = static_cast<std::int32_t>(sum.xy) / units;
    return 100 * (xx * (1 - xx) - xy * xy) <= 9;
  }
};

/// What is to be known of a flat triangle with these canonical corners.
TRISMOOTH_HOST_DEVICE inline FlatTriangle described_flat(const Triangle& corners, Point2<double> a, Point2<double> b,
                                                         Point2<double> c) {
  const Point2<double> ab = b - a;
  const Point2<double> bc = c - b;
  const Point2<double> ac = c - a;
  const double squares[3] = {squared_length(ab), squared_length(bc), squared_length(ac)};
  const int longest = squares[1] > squares[0] ? (squares[2] > squares[1] ? 2 : 1) : (squares[2] > squares[0] ? 2 : 0);
  const double m = squares[(longest + 1) % 3];
  const double n = squares[(longest + 2) % 3];
  // The law of cosines: excess = -2 sqrt(m n) cos(angle).
  const double excess = squares[longest] - m - n;
  constexpr double square_of_cosine_110 = 0.11697777844051098;
  const auto [xx, xy] = flat_tensor(a, b, c);
  FlatTriangle flat{corners, FlatTriangle::Angle::moderate, xx, xy, shape_quotient(a, b, c)};
  if (excess > 0 && excess * excess > 2 * (m * n)) {
    flat.angle = FlatTriangle::Angle::obtuse;
  } else if (excess > 0 && excess * excess >= 4 * square_of_cosine_110 * (m * n)) {
    flat.angle = FlatTriangle::Angle::wide;
  }
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

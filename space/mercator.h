// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "trismooth/base/exact_arithmetic.h"

namespace trismooth {

/// The Mercator projection of the sphere: the coordinate of a latitude in which shapes are those on the sphere (it is
/// conformal: Snyder, Map Projections - A Working Manual, 1987, pages 38 to 47). On the host. Of + - * / and sqrt
/// alone, by series for arguments that are made small (Muller, Elementary Functions, 2016): C libraries differ in the
/// last digits of theirs, and results must not. Right to a few units in the last place.
namespace mercator_details {

inline constexpr double degree = 0.017453292519943295;  // in radians

/// sum of z^(2 i) / (2 i + 1) for i < terms, with alternating signs for sign = -1: atanh(z) / z or atan(z) / z.
inline double odd_series(double square, int terms, double sign) {
  double sum = 0;
  for (int i = terms - 1; i >= 0; --i) {
    sum = 1.0 / (2 * i + 1) + sign * square * sum;
  }
  return sum;
}

/// For |z| up to 0.42.
inline double small_atanh(double z) {
  constexpr int terms = 23;
  return z * odd_series(z * z, terms, 1);
}

/// For |z| up to 0.42.
inline double small_atan(double z) {
  constexpr int terms = 13;
  const double half = z / (1 + std::sqrt(1 + z * z));
  return 2 * (half * odd_series(half * half, terms, -1));
}

/// For |angle| up to pi / 8, in radians.
inline double small_tan(double angle) {
  constexpr int terms = 9;
  const double square = angle * angle;
  double sine = 1;
  double cosine = 1;
  for (int i = terms; i > 0; --i) {
    sine = 1 - square * sine / ((2 * i) * (2 * i + 1));
    cosine = 1 - square * cosine / ((2 * i - 1) * (2 * i));
  }
  return angle * sine / cosine;
}

/// Of a positive normal number.
inline double logarithm(double value) {
  constexpr double root_of_half = 0.7071067811865476;
  auto bits = std::bit_cast<std::uint64_t>(value);
  int exponent = static_cast<int>(bits >> 52U) - 1022;
  bits = (bits & 0x000FFFFFFFFFFFFFU) | 0x3FE0000000000000U;
  double mantissa = std::bit_cast<double>(bits);  // from 1/2 to 1
  if (mantissa < root_of_half) {
    mantissa *= 2;
    --exponent;
  }
  return exponent * std::numbers::ln2 + 2 * small_atanh((mantissa - 1) / (mantissa + 1));
}

/// exp(value) - 1 for |value| up to 1.
inline double small_expm1(double value) {
  constexpr int terms = 20;
  double sum = 1;
  for (int i = terms; i > 1; --i) {
    sum = 1 + value * sum / i;
  }
  return value * sum;
}

/// exp(-value) for value from 0 to 700.
inline double falling_exponential(double value) {
  const auto halvings = static_cast<int>(std::lround(value / std::numbers::ln2));
  // ln 2 in two parts, of which the first has few digits: its multiples are exact.
  constexpr double ln2_high = 0x1.62e42fefap-1;  // NOLINT(modernize-use-std-numbers): not all of it
  constexpr double ln2_low = 0x1.cf79abc9e3b39p-40;
  const double rest = (value - halvings * ln2_high) - halvings * ln2_low;
  const double power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - halvings) << 52U);
  return power * (1 + small_expm1(-rest));
}

inline constexpr double half_way = 0.881373587019543;  // the coordinate of 45 degrees, in radians

}  // namespace mercator_details

/// The coordinate of a latitude, both in degrees of arc (that of the equator is 0, and there the scale is 1); below 90
/// degrees in size.
inline double mercator_of_latitude(double latitude) {
  using namespace mercator_details;
  const double size = std::abs(latitude);
  // tan(pi / 4 + phi / 2) = (1 + t) / (1 - t) with t = tan(phi / 2), and = 1 / tan(half of the angle to the pole).
  const double coordinate =
      size <= 45 ? 2 * small_atanh(small_tan(size * degree / 2)) : -logarithm(small_tan((90 - size) * degree / 2));
  return latitude < 0 ? -coordinate / degree : coordinate / degree;
}

/// The latitude of a coordinate.
inline double latitude_of_mercator(double coordinate) {
  using namespace mercator_details;
  const double size = std::abs(coordinate) * degree;
  constexpr double farthest = 700;  // half a unit of the last place from the pole
  double latitude = 90;
  if (size <= half_way) {
    const double rise = small_expm1(size);
    latitude = 2 * small_atan(rise / (rise + 2)) / degree;  // tanh(y / 2)
  } else if (size < farthest) {
    latitude = 90 - 2 * small_atan(falling_exponential(size)) / degree;
  }
  return coordinate < 0 ? -latitude : latitude;
}

}  // namespace trismooth

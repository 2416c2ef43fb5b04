// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"

/// Equal where zeros have the same sign, and a NaN equals itself.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_bits(trismooth::Point2<double> a, trismooth::Point2<double> b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y);
}

inline bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, [](double x, double y) { return same_bits(x, y); });
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace trismooth {

/// True where `value` is a number of the integer type T; -0 is none, which would lose its sign.
template <class T>
bool holds_exactly(double value) {
  if constexpr (std::is_integral_v<T>) {
    // One beyond the largest number is a power of two: exact, which the largest of 64 bits is not.
    const double lowest = static_cast<double>(std::numeric_limits<T>::lowest());
    const double beyond = std::ldexp(1.0, std::numeric_limits<T>::digits);
    return lowest <= value && value < beyond && std::trunc(value) == value && !(value == 0 && std::signbit(value));
  } else {
    return static_cast<double>(static_cast<T>(value)) == value;
  }
}

}  // namespace trismooth

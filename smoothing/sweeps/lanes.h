// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

namespace trismooth {

/// As many numbers as fill a SIMD register: on x86-64 every processor has 16 bytes, one with AVX2 32.
template <class T, int bytes>
struct LanesOf {
  static constexpr int count = bytes / static_cast<int>(sizeof(T));
  // An alias may not have an attribute that depends on T.
  typedef T type __attribute__((vector_size(bytes)));  // NOLINT(modernize-use-using)
};
template <class T, int bytes>
using Lanes = typename LanesOf<T, bytes>::type;

/// number(0), number(1), ... in a register: written to memory one by one they would be late to be read as one.
template <class T, int bytes, class Number>
Lanes<T, bytes> joined(const Number& number) {
  return [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return Lanes<T, bytes>{number(lane)...};
  }
  (std::make_integer_sequence<int, LanesOf<T, bytes>::count>());
}

}  // namespace trismooth

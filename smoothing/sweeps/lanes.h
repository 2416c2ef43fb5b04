#pragma once

#include <utility>

namespace trismooth {

/// As many numbers as fill the narrowest SIMD register: on x86-64 every processor has 16 bytes.
template <class T>
struct LanesOf {
  static constexpr int count = static_cast<int>(16 / sizeof(T));
  // An alias may not have an attribute that depends on T.
  typedef T type __attribute__((vector_size(16)));  // NOLINT(modernize-use-using)
};
template <class T>
using Lanes = typename LanesOf<T>::type;

/// number(0), number(1), ... in a register: written to memory one by one they would be late to be read as one.
template <class T, class Number>
Lanes<T> joined(const Number& number) {
  return [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return Lanes<T>{number(lane)...};
  }
  (std::make_integer_sequence<int, LanesOf<T>::count>());
}

}  // namespace trismooth

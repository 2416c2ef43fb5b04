// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth::cuda {

/// 1 / n in T, correctly rounded as by a division: the compiler has divided.
template <class T>
struct Reciprocals {
  static constexpr int count = 17;
  T values[count];

  constexpr Reciprocals() : values{} {
    for (int n = 1; n < count; ++n) {
      values[n] = T(1) / static_cast<T>(n);
    }
  }
};

__constant__ const Reciprocals<float> float_reciprocals;
__constant__ const Reciprocals<double> double_reciprocals;

/// `n` is below Reciprocals::count.
template <class T>
__device__ T small_reciprocal(int n) {
  if constexpr (sizeof(T) == sizeof(float)) {
    return float_reciprocals.values[n];
  } else {
    return double_reciprocals.values[n];
  }
}

}  // namespace trismooth::cuda

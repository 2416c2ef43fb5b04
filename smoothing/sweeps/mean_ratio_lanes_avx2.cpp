// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2 as a whole: GCC takes vectors of 32 bytes apart early, by the function that they are first used
// in. No code of it may end up in functions that others call, too: it has no function but those of 32 bytes, which are
// its own, and everything is inlined into them, in every kind of build (a test looks).
#if defined(__AVX2__)

#include "trismooth/smoothing/sweeps/mean_ratio_group.h"

namespace trismooth {

#define FIND_IN_LANES_AVX2(T, shaped, is_last)                           \
  void mean_ratio_lanes_avx2(MeanRatioLanes<T, shaped, is_last>& find) { \
    find = &find_in_lanes<T, shaped, is_last, 32>;                       \
  }
FIND_IN_LANES_AVX2(float, false, false)
FIND_IN_LANES_AVX2(float, false, true)
FIND_IN_LANES_AVX2(float, true, false)
FIND_IN_LANES_AVX2(float, true, true)
FIND_IN_LANES_AVX2(double, false, false)
FIND_IN_LANES_AVX2(double, false, true)
FIND_IN_LANES_AVX2(double, true, false)
FIND_IN_LANES_AVX2(double, true, true)

}  // namespace trismooth

#endif

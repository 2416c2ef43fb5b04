// Compiled with -mavx2 as a whole: GCC takes vectors of 32 bytes apart early, by the function that they are first used
// in. No code of it may end up in functions that others call, too: it has no function but those of 32 bytes, into which
// everything is inlined (a test looks).
#if defined(__AVX2__)

#include "trismooth/smoothing/sweeps/mean_ratio_group.h"

namespace trismooth {

template <class T, bool shaped, bool is_last>
MeanRatioLanes<T, shaped, is_last> mean_ratio_lanes_avx2() {
  return &find_in_lanes<T, shaped, is_last, 32>;
}

#define FIND_IN_LANES_AVX2(T)                                                        \
  template MeanRatioLanes<T, false, false> mean_ratio_lanes_avx2<T, false, false>(); \
  template MeanRatioLanes<T, false, true> mean_ratio_lanes_avx2<T, false, true>();   \
  template MeanRatioLanes<T, true, false> mean_ratio_lanes_avx2<T, true, false>();   \
  template MeanRatioLanes<T, true, true> mean_ratio_lanes_avx2<T, true, true>()
FIND_IN_LANES_AVX2(float);
FIND_IN_LANES_AVX2(double);

}  // namespace trismooth

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/mean_ratio_lanes.h"

#include "trismooth/smoothing/sweeps/mean_ratio_group.h"

namespace trismooth {

template <class T, bool shaped, bool is_last>
MeanRatioLanes<T, shaped, is_last> mean_ratio_lanes([[maybe_unused]] InstructionSet instructions) {
  MeanRatioLanes<T, shaped, is_last> find = &find_in_lanes<T, shaped, is_last, 16>;
#if defined(TRISMOOTH_HAS_AVX2_SOURCES)
  if (instructions == InstructionSet::avx2) {
    mean_ratio_lanes_avx2(find);
  }
#endif
  return find;
}

#define FIND_IN_LANES(T)                                                                      \
  template MeanRatioLanes<T, false, false> mean_ratio_lanes<T, false, false>(InstructionSet); \
  template MeanRatioLanes<T, false, true> mean_ratio_lanes<T, false, true>(InstructionSet);   \
  template MeanRatioLanes<T, true, false> mean_ratio_lanes<T, true, false>(InstructionSet);   \
  template MeanRatioLanes<T, true, true> mean_ratio_lanes<T, true, true>(InstructionSet)
FIND_IN_LANES(float);
FIND_IN_LANES(double);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// How the areas of a mesh's elements changed when its vertices moved: over the ratios A / A0 of those that are valid
/// (shape > 0) before and after. All NaN where there is none. A mesh whose vertices did not move has 0, 1 and 1.
struct SizeChange {
  std::int64_t triangles = 0;  ///< elements whose areas are compared
  std::int64_t left_out = 0;   ///< the others: inverted or degenerate before or after
  double rms_log_ratio = 0;    ///< the root mean square of ln(A / A0): 0.1 is about 10 % up or down
  double ratio_p1 = 1;         ///< the 1st percentile of A / A0: the smallest ratio that 1 % do not exceed
  double ratio_p99 = 1;        ///< the 99th percentile: the smallest ratio that 99 % do not exceed
};

/// The change from `before` to `after`, which have the same elements, `reversed` or not, in the same order; frames may
/// differ. The same to the bit for every number of threads, which is as in QualityOptions. Throws std::invalid_argument
/// for numbers of elements that differ, and for a number of threads out of range. Complexity: linear, with 8 bytes an
/// element.
[[nodiscard]] SizeChange size_change(const MeshView& before, const MeshView& after, int threads = 0);

}  // namespace trismooth

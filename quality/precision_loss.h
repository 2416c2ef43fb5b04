// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// What the elements of a mesh lose where their corners are rounded to float32 in the local frame, which is where
/// sweeps in single precision begin. A mesh whose elements differ in size by more than some 1e6 times has its smallest
/// ones collapse.
struct PrecisionLoss {
  std::int64_t elements = 0;   ///< of the mesh
  std::int64_t collapsed = 0;  ///< of shape > 0 in double, degenerate or inverted in single precision
  std::int64_t distorted = 0;  ///< others whose shape changes by more than distortion_limit

  bool any() const { return collapsed > 0 || distorted > 0; }
};

/// The change of shape above which an element counts as distorted.
inline constexpr double distortion_limit = 0.01;

/// Counts them; the corners in their canonical order. `threads` as in QualityOptions. Complexity: linear.
PrecisionLoss single_precision_loss(const MeshView& view, int threads = 0);

/// One sentence that says what was lost, for people. There is something.
std::string describe(const PrecisionLoss& loss);

}  // namespace trismooth

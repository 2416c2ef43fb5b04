// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// The quality of the elements of one region. The numbers are NaN where it has none.
struct RegionQuality {
  std::int64_t triangles = 0;
  std::int64_t inverted = 0;  ///< of shape < 0
  double min_shape = 0;
  double mean_shape = 0;
  double min_angle = 0;  ///< the smallest angle, in degrees
  std::int64_t quadrilaterals = 0;

  /// How many there are of both kinds.
  [[nodiscard]] std::int64_t elements() const { return triangles + quadrilaterals; }
};

/// The quality of each of `region_count` regions; `region_of` has a number below that for every element of the view.
/// Shapes and angles are those of quality_report(), and the result is the same to the bit for every number of threads
/// (0: all). Complexity: linear; memory of 4 bytes an element.
std::vector<RegionQuality> region_quality(const MeshView& view, std::span<const std::int32_t> region_of,
                                          std::int32_t region_count, int threads = 0);

}  // namespace trismooth

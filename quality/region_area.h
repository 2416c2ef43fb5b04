// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// The area of each of `region_count` regions, in the local frame: signed, as the orientation has it. `region_of` has a
/// number below that for every element of the view; empty: all are of region 0. Summed with compensation (Neumaier
/// 1974), so that a region that stays as it is has the same area wherever the vertices inside are, to a unit or so in
/// the last place. Complexity: linear.
std::vector<double> region_areas(const MeshView& view, std::span<const std::int32_t> region_of,
                                 std::int32_t region_count);

}  // namespace trismooth

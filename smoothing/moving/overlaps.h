// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"

namespace trismooth {

class Workers;

/// The vertices around which a mesh lies over itself, ascending: the elements around a free one (`held` is 0) go round
/// it more than once, those around another one make an angle of more than a full turn, by 1e-9 or more. Where
/// there are none, no element is inverted and no edges of the boundary meet, a mesh lies over itself nowhere.
/// `elements` are listed clockwise where `reversed` is 1; `points`: in a frame in which a mesh is about 1 wide. The
/// same for every number of threads. Complexity: linear.
std::vector<std::int32_t> overlapping_vertices(const ElementList& elements, std::span<const std::uint8_t> reversed,
                                               std::span<const std::uint8_t> held,
                                               std::span<const Point2<double>> points, Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/element_list.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth {

class Workers;

/// What find_slidable() is to look at of these elements. `fixed`: as MeshRings::fixed; `regions`: one an element, or
/// none. Complexity: linear.
NearLines near_lines(const ElementList& elements, std::span<const std::uint8_t> fixed,
                     std::span<const std::int32_t> regions, Workers& workers);

}  // namespace trismooth

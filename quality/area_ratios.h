// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/quality/size_change.h"

namespace trismooth {

/// Elements whose logarithms are added up before they are added to those of others, in the order of the elements.
inline constexpr std::size_t triangles_a_size_part = 1024;

/// What size_change() is made of.
struct AreaRatios {
  BulkVector<double> ratios;  ///< A / A0 of every element, NaN where it is left out
  std::vector<double> sums;   ///< of the squares of ln(A / A0) of triangles_a_size_part elements each, the last fewer
};

/// Makes it. Arguments and errors as those of size_change().
AreaRatios area_ratios(const MeshView& before, const MeshView& after, int threads = 0);

/// Adds to counts, one by one, those that others have found who have the rest of the mesh.
using AddUpCounts = std::function<void(std::vector<std::int64_t>&)>;

/// size_change() from these ratios and those that others have. `sum`: of all AreaRatios::sums, in their order.
/// Complexity: linear, and at most ten calls of `add_up` with at most 8,192 counts.
SizeChange size_change_of(std::span<const double> ratios, double sum, const AddUpCounts& add_up, int threads);

}  // namespace trismooth

#pragma once

#include <cstddef>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// Triangles whose logarithms are added up before they are added to those of others, in the order of the triangles.
inline constexpr std::size_t triangles_a_size_part = 1024;

/// What size_change() is made of.
struct AreaRatios {
  BulkVector<double> ratios;  ///< A / A0 of every triangle, NaN where it is left out
  std::vector<double> sums;   ///< of the squares of ln(A / A0) of triangles_a_size_part triangles each, the last fewer
};

/// Makes it. Arguments and errors as those of size_change().
AreaRatios area_ratios(const TriangleView& before, const TriangleView& after, int threads = 0);

}  // namespace trismooth

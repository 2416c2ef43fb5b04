// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/index_view.h"

namespace trismooth {

class Workers;

/// A triangle, or quadrilateral, that is listed again.
struct RepeatedTriangle {
  std::int32_t triangle;  ///< its number
  std::int32_t first;     ///< that of the lowest one with the same sides, which is none that is listed again

  bool operator==(const RepeatedTriangle&) const = default;
};

/// The triangles that have the three corners of one before them, in whatever order, and the quadrilaterals with the
/// four sides of one before them; ascending. Programs list elements again for every group that has them. What smooths
/// holds the corners of such triangles, and what judges a mesh counts them as often as they are listed: so leave them
/// out before. `threads`: 0 for all; the result does not depend on it. Throws MeshError for a corner that has no place
/// in 32 bits, std::invalid_argument for a wrong number of threads. Complexity: linear, and n log n in the triangles
/// that are there more than once; 3 to 5 bytes a triangle of memory, for a while.
std::vector<RepeatedTriangle> find_repeated_triangles(const IndexView& triangles, int threads = 0);

/// find_repeated_triangles() by threads that are there.
std::vector<RepeatedTriangle> find_repeated_triangles(const IndexView& triangles, Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// How far the areas A of elements are from those asked for, A*, over the elements that are valid (shape > 0) and
/// have a vertex that may move. All A* are scaled by one factor, so that their sum is the sum of the areas: with so
/// many elements, only relations of sizes can be met.
struct SizeFit {
  std::int64_t elements = 0;  ///< whose areas are compared
  std::int64_t left_out = 0;  ///< the others with a vertex that may move: inverted or degenerate
  double rms_log_ratio = 0;   ///< the root mean square of ln(A / A*): 0.1 is about 10 % up or down; NaN of none
};

/// Finds it. `inverse_areas`: for every vertex 1 / (area asked for around it), in any unit; a triangle is asked to have
/// the harmonic mean of its corners', a quadrilateral twice that. `held`: not 0 for vertices that do not move. The same
/// to the bit for every number of threads, which is as in QualityOptions. Throws std::invalid_argument for a number of
/// threads out of range. Complexity: linear, with 8 bytes an element.
[[nodiscard]] SizeFit size_fit(const MeshView& view, std::span<const double> inverse_areas,
                               std::span<const std::uint8_t> held, int threads = 0);

}  // namespace trismooth

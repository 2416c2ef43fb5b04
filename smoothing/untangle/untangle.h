// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/rings/packed_rings.h"

namespace trismooth {

class Workers;

/// What untangle() did. Elements without a free vertex are not counted: nobody can mend them.
struct UntangleOutcome {
  std::int64_t inverted_before = 0;  ///< elements that were inverted or degenerate, a quadrilateral in any corner
  std::int64_t inverted_after = 0;   ///< and are so afterwards: never more
  std::int64_t by_averages = 0;      ///< mended by moving corners to the mean of their neighbours
  std::int64_t by_kernels = 0;       ///< mended by moving single vertices to where all that moves with them is valid
  std::int64_t by_embedding = 0;     ///< mended by Tutte's embedding of a part of the mesh
  std::int64_t by_energy = 0;        ///< mended by the regularised energy on a part of the mesh
  /// Parts of the mesh that cannot be untangled as they are oriented: their elements have no positive area in all,
  /// wherever the free vertices are.
  std::int64_t parts_of_no_area = 0;
};

/// Areas that cancel out to this part of what they are without their signs are no area: the rest is rounding.
inline constexpr double no_area = 1e-10;

/// Moves free vertices until no element around them is inverted or degenerate, as far as that can be found. `points`:
/// one for each vertex of the mesh in the numbering of `rings`, in the local frame, changed in place.
///
/// Where nothing is inverted nothing moves, and it costs one pass. Otherwise the means are, from the cheapest to the
/// dearest, each for what those before it have left: corners of inverted elements go to the mean of their neighbours
/// along sides for some passes; single vertices go into the kernel of their ring; parts of the mesh around what is
/// left, which grow until they are all that hangs together, are embedded anew (Tutte) and brought down in a regularised
/// energy. What has not fewer inverted elements than before is not kept.
///
/// The result depends on the mesh and its points alone, not on the order of `rings` in memory nor on the threads, and
/// scales with the mesh by powers of two, bit for bit.
UntangleOutcome untangle(const RingView& rings, std::span<Point2<double>> points, Workers& workers);

/// The elements with a free vertex that are inverted or degenerate. Complexity: one pass.
std::int64_t inverted_elements(const RingView& rings, std::span<const Point2<double>> points, Workers& workers);

/// inverted_elements() of a part of a mesh of triangles: those that several parts know are counted in one of them.
/// Complexity: linear.
std::int64_t inverted_elements_of_part(const PackedRings& rings, std::span<const Point2<double>> points);

}  // namespace trismooth

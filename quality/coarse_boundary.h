// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// Boundary edges that are many times longer than what lies behind them. No method moves boundary vertices, and every
/// one moves those behind such an edge away from it: elements beside it grow to its size. Shapes get better by that and
/// solutions on the mesh worse.
struct CoarseBoundary {
  std::int64_t boundary_edges = 0;  ///< of the mesh
  std::int64_t coarse_edges = 0;    ///< of those boundary curves that are coarse on a good part of their length
  double largest_ratio = 0;         ///< of a coarse edge's length to what lies behind it; 0 where there is none

  bool any() const { return coarse_edges > 0; }
};

/// An edge is coarse where it is more than this times as long as the edges behind it.
inline constexpr double coarse_ratio = 4;

/// A boundary curve counts where coarse edges make up this part of its length. A mesh of random points with a boundary
/// as fine as its inside has a few coarse edges by chance, below a tenth.
inline constexpr double coarse_part = 0.2;

/// Finds them. `held` says of each vertex why it is held (bits of namespace hold). What lies behind an edge are the
/// edges at the free vertex opposite of it (of a quadrilateral, across from the end that comes first), but for the two
/// to the edge's own ends: the median of their lengths. So layers of flat elements along a boundary are no reason for
/// alarm, and the sizes of a graded mesh are not either. Edges opposite of held vertices are never coarse: nothing
/// there can move away. The same for every number of threads, which is as in QualityOptions. Complexity: linear, but
/// for sorting the boundary edges; no memory beside theirs and one byte a vertex.
CoarseBoundary find_coarse_boundary(const MeshView& view, std::span<const std::uint8_t> held, int threads = 0);

/// A sentence that says what was found, for people. There is something.
std::string describe(const CoarseBoundary& boundary);

}  // namespace trismooth

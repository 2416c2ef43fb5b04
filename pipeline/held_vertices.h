// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "trismooth/smoothing/result.h"

namespace trismooth {

class Workers;

/// How many vertices are held, by reason. A vertex with several reasons counts for each of them.
struct HeldVertices {
  std::int64_t boundary = 0;      ///< on an edge with one element
  std::int64_t interface = 0;     ///< on an edge between two regions
  std::int64_t non_manifold = 0;  ///< on an edge with three elements or more
  std::int64_t bow_tie = 0;       ///< where elements meet in a point only; those of non_manifold do not count again
  std::int64_t other_cells = 0;   ///< of a cell that is no element, or linked with another vertex
  std::int64_t unused = 0;        ///< of no cell
  std::int64_t named = 0;         ///< by an array, by a set of the file or by a file of numbers
  std::int64_t layers = 0;   ///< of layers that are flat on purpose, and held, or kept from sliding, for that alone
  std::int64_t several = 0;  ///< for more than one of these reasons
};

/// How many vertices have each combination of the bits of namespace hold.
using ReasonCounts = std::array<std::int64_t, 256>;

/// Counts them, one byte a vertex. Complexity: linear.
ReasonCounts count_reasons(std::span<const std::uint8_t> reasons, Workers& workers);

/// The vertices held by reason. `layers`: of those named, the ones that are so as parts of layers.
HeldVertices count_held(const ReasonCounts& counts, const LayersResult& layers);

}  // namespace trismooth

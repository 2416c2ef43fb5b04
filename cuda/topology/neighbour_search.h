// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/findings.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// Who finds the neighbours. What is found is the same.
enum class NeighbourSearch : std::uint8_t {
  parallel,   ///< one thread for each triangle
  one_thread  ///< one block of one thread, the paper's way
};

/// Who finds them for this execution.
constexpr NeighbourSearch neighbour_search(Execution execution) {
  return execution == Execution::single_block ? NeighbourSearch::one_thread : NeighbourSearch::parallel;
}

/// Finds the neighbours and incident elements of every vertex, and reports triangles that name a vertex out of range or
/// one twice, which are left out, and the large vertices. Queued.
IncidentCorners find_neighbours(Context& context, std::int32_t vertex_count, const TriangleList& triangles,
                                NeighbourSearch way, Findings* findings);

}  // namespace trismooth::cuda

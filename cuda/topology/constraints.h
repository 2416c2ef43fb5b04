#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/findings.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/parity_forest.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// What the caller holds fixed, in device memory of the caller's; null where there is nothing. See
/// trismooth::Constraints.
struct DeviceConstraints {
  const std::uint8_t* fixed = nullptr;        ///< one flag a vertex
  const std::uint8_t* other_cells = nullptr;  ///< one flag a vertex
  const std::int32_t* fixed_ids = nullptr;    ///< vertex numbers
  std::int32_t fixed_id_count = 0;
  const std::int32_t* regions = nullptr;  ///< one number a triangle
};

/// Determines the constraints: writes the bits of namespace hold for every vertex of no more than VertexFan::capacity
/// triangles, and the caller's for the others. On the way every edge with exactly two triangles joins them in `forest`,
/// of which each triangle is a tree of its own before. Reports numbers out of range in `fixed_ids`, which are left out,
/// and one-sided surfaces. Queued.
void determine_constraints(Context& context, const TriangleList& triangles, const CornersView& corners,
                           const DeviceConstraints& constraints, const ParityForest& forest, std::uint8_t* fixed,
                           Findings* findings);

}  // namespace trismooth::cuda

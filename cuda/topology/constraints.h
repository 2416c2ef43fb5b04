// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/parity_forest.h"
#include "trismooth/cuda/device_constraints.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/findings.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// Determines the constraints: writes the bits of namespace hold for every vertex of no more than VertexFan::capacity
/// triangles, and the caller's for the others. On the way every edge with exactly two triangles joins them in `forest`,
/// of which each triangle is a tree of its own before. Reports numbers out of range in `fixed_ids`, which are left out,
/// and one-sided surfaces. Queued.
void determine_constraints(Context& context, const TriangleList& triangles, const CornersView& corners,
                           const DeviceConstraints& constraints, const ParityForest& forest, std::uint8_t* fixed,
                           Findings* findings);

/// Holds those of these vertices that move (see moves_in_layer()), as if the user named them. Each is there once.
/// Answers one byte for each: what held it before. Waits for the device.
std::vector<std::uint8_t> hold_of_layers(Context& context, const std::vector<std::int32_t>& vertices, bool slides,
                                         std::uint8_t* fixed);

}  // namespace trismooth::cuda

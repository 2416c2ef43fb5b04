// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/topology/neighbour_search.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth::cuda {

/// find_mesh_rings() by the current device, from and to the host: the same in every number, with the same errors.
/// Throws DeviceError as well.
MeshRings find_rings_on_device(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                               const Constraints& constraints, NeighbourSearch way, Layers layers = Layers::smooth);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/smoothing/constraints.h"

namespace trismooth::mpi {

/// Checks what can be wrong with what one rank hands in, whatever the others have. `triangles`: those of `mesh`;
/// `ranks`: how many there are. Throws MeshError and std::invalid_argument as build_overlap() says. Complexity: linear
/// where ids ascend, else n log n. Local.
void check_local_mesh(const LocalMesh& mesh, std::span<const Triangle> triangles, const Constraints& constraints,
                      int ranks);

}  // namespace trismooth::mpi

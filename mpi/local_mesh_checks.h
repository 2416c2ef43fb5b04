// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/element_list.h"
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/smoothing/constraints.h"

namespace trismooth::mpi {

/// Checks what can be wrong with what one rank hands in, whatever the others have. `elements`: those of `mesh`;
/// `ranks`: how many there are. Throws MeshError and std::invalid_argument as build_overlap() says. Complexity: linear
/// where ids ascend, else n log n. Local.
void check_local_mesh(const LocalMesh& mesh, const ElementList& elements, const Constraints& constraints, int ranks);

}  // namespace trismooth::mpi

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/msh/msh_elements.h"

namespace trismooth {

/// Versions 1 and 2 list an element again for every further group that its entity is in. Such elements, of the same
/// entity, type and nodes, are one cell: the later ones are taken out of `cells`, their groups become further groups.
/// `elements` has the labels of all. Complexity: linear where every entity is in one group, else n log n in the
/// elements of those that are not.
void merge_repeated_elements(CellList& cells, MshElements& elements);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The point array of numbers in the whole mesh, of which the document may be a piece: the one that is marked as global
/// ids, or called GlobalNodeIds or GlobalPointIds; nullptr where there is none. Complexity: linear in the arrays.
const DataArray* find_global_ids(const MeshDocument& document);

}  // namespace trismooth

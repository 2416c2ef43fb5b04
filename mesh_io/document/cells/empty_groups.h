// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The names of the document's groups (see find_cell_groups()), sets of cells and sets of points that have no members.
/// Complexity: that of find_cell_groups().
std::vector<std::string> names_of_empty_groups(const MeshDocument& document);

/// The document without these. For formats that hold none. Complexity: likewise.
MeshDocument without_empty_groups(MeshDocument document);

}  // namespace trismooth

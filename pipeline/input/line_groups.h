// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/file_groups.h"

namespace trismooth {

/// The names that the document's cell arrays have for values of line cells, in the order of the arrays and of their
/// names; those that no line has count none. Complexity: n log n in the lines.
std::vector<FileLineGroup> find_line_groups(const MeshDocument& document);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trismooth/base/cell_list.h"

namespace trismooth {

/// The edges of triangles and quads that belong to one of these alone, and are no line cell: what formats with a
/// boundary of their own need beside the lines that a document has. Where a quad repeats a corner there is none. In the
/// order of the cells, directed as these are. Complexity: linear, but for vertices of very many edges.
std::vector<std::array<std::int32_t, 2>> find_boundary_edges(const CellList& cells);

}  // namespace trismooth

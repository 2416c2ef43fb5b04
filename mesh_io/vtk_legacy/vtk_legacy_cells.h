// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_input.h"

namespace trismooth {

/// The cells of one section (CELLS, POLYGONS, ...) whose keyword, `section`, was just read: those of the old form
/// (each cell's vertices behind their number) or of the form of version 5 (OFFSETS and CONNECTIVITY). Their types
/// are left out. Every index is checked against `point_count`; a message names the cell.
CellList read_vtk_legacy_cells(VtkLegacyInput& input, std::string_view section, std::size_t point_count);

/// Reads what follows the keyword CELL_TYPES into cells.types and checks it against the number of the cells and the
/// number of vertices of each.
void read_vtk_legacy_cell_types(VtkLegacyInput& input, CellList& cells);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_input.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"

namespace trismooth {

/// Reads what follows the keyword FIELD before the point and cell data: arrays of the whole mesh, of any length.
void read_vtk_legacy_field(VtkLegacyInput& input, MeshDocument& document);

/// Reads the POINT_DATA and CELL_DATA sections, in any order and number, to the end of the file. The points and cells
/// of the document must be there. Arrays of numbers and bits go to the document; strings, variants and lookup tables
/// are passed, with a note. Fills the layout's section and names.
void read_vtk_legacy_attributes(VtkLegacyInput& input, MeshDocument& document, VtkLegacyLayout& layout);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/cgns/cgns_sections.h"
#include "trismooth/mesh_io/cgns/cgns_tree.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

struct CgnsSolutions {
  std::vector<DataArray> point_arrays;  ///< those that have values at the vertices of all zones
  std::vector<DataArray> cell_arrays;   ///< those at the cells of all zones; other cells have 0, or no number
  std::vector<Hdf5Column> columns;      ///< where the values of points are
  std::vector<std::string> notes;       ///< of all others, that they are kept
};

/// The solutions of the zones, whose points and cells are those of the document. Cells of a zone are those of that
/// dimension. Where a zone has several solutions of a kind, a name that the first has not alone stands behind the
/// solution's: "Step2/Pressure". "VelocityX" and "VelocityY" (and Z) are "Velocity". Complexity: linear in their
/// values.
CgnsSolutions read_cgns_solutions(CgnsTree& tree, std::span<const CgnsZone> zones, int cell_dimension,
                                  const MeshDocument& document);

}  // namespace trismooth

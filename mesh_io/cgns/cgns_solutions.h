// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/cgns/cgns_sections.h"
#include "trismooth/mesh_io/cgns/cgns_tree.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

struct CgnsSolutions {
  std::vector<DataArray> arrays;    ///< those that have values at the vertices of all zones
  std::vector<Hdf5Column> columns;  ///< where these values are
  std::vector<std::string> notes;   ///< of all others, that they are kept
};

/// The solutions of the zones, which have `points` vertices together. Where a
/// zone has several, a name that the first has not alone stands behind the
/// solution's: "Step2/Pressure". Complexity: linear in their values.
CgnsSolutions read_cgns_solutions(CgnsTree& tree, std::span<const CgnsZone> zones, std::size_t points);

}  // namespace trismooth

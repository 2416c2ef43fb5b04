// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"

namespace trismooth {

/// Numbers of a point array that are others now than those in the file.
struct VtkLegacyChanges {
  NumberSites sites;           ///< one column; site i gets the number i of `values`
  std::vector<double> values;  ///< in the file's order
};

/// What of the floating-point arrays of the points differs, bit for bit, in `arrays`, those of a document; an entry for
/// each of the layout's that has any difference, in the file's order. Arrays of another name, type or number of
/// components than the file's are not compared. `bytes` is the file. Arrays that share the file's numbers take no time;
/// else linear in the array's text.
std::vector<VtkLegacyChanges> changed_values(std::string_view bytes, const VtkLegacyLayout& layout,
                                             std::span<const DataArray> arrays);

/// What takes these changes into the file.
std::vector<ByteEdit> edits_of(std::string_view bytes, const VtkLegacyChanges& changes);

}  // namespace trismooth

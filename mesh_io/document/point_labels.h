// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// What a format with one number for a point gets from a document: the first point array of whole numbers and one
/// component whose name is_region_name(); null where there is none.
const DataArray* find_point_labels(const MeshDocument& document);

/// The value of such an array.
std::int64_t point_label(const DataArray& labels, std::size_t point);

/// One sentence for every kind of array that the document has beside `labels` (which may be null) and those of
/// the groups, and one for the names of these: what a format does not hold that has a number for a point and for a
/// cell.
std::vector<std::string> describe_unlabelled_arrays(std::string_view format, const MeshDocument& document,
                                                    const DataArray* labels, const CellGroups& groups);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/pipeline/input/region_judge.h"
#include "trismooth/pipeline/region_array.h"

namespace trismooth {

/// The regions of a mesh. Two triangles are in one region if all arrays agree on them. One that is listed again with
/// other values is in none of their regions, but in that of those that are listed with the same values.
struct Regions {
  std::vector<RegionArray> arrays;        ///< the cell arrays that were obeyed, in the file's order
  std::vector<std::int32_t> of_triangle;  ///< a number from 0 for each triangle; empty where no array was obeyed
  std::vector<std::string> names;  ///< of each region: its value in the file; of several arrays, "1, 7"; or the name
                                   ///< that the file has for it, with the value behind where names repeat
  std::vector<std::string> notes;  ///< what the user should know, one sentence each

  std::int32_t count() const { return static_cast<std::int32_t>(names.size()); }
};

/// The regions by the cell arrays `names`, or, where that is empty, by those that the document has, but for `sizes`,
/// which the user wants for another purpose. `names` may be no_region_arrays alone. Error messages say of `owner` that
/// the arrays are its own.
///
/// Of the document's arrays every one of one component and two values or more counts that
/// - has a name under which programs write regions (region_names.h) and changes across at most half of the inner edges,
/// - or holds whole numbers or texts, few different ones (10, or one for 8 triangles; fewer than triangles), changes
///   across at most a third of the inner edges and has no name of bookkeeping or of this program (annotation_names.h).
///   A note names it.
/// A note tells of an array that counts by its name but changes across more edges, and of those that fail at one of the
/// other conditions alone. Where no array counts, one of a known name that has the same value everywhere is named.
///
/// Throws std::invalid_argument where `names` names no cell array of the document, or one of several components; the
/// message lists those there are. Complexity: linear, and n log n where values change from triangle to triangle.
Regions find_regions(const MeshDocument& document, const ElementCells& mesh, std::span<const std::string> names = {},
                     std::string_view sizes = {}, const ArrayOwner& owner = {});

}  // namespace trismooth

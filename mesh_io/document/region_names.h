// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// Whether programs write regions under that name of a cell array ("attribute", "gmsh:physical", "SubdomainID", ...).
/// Compared by plain_name(): without case, blanks and punctuation. The list is in region_names.cpp.
bool is_region_name(std::string_view name);

/// Whether a cell array of that name marks a named boundary by sides of triangles, as scikit-fem writes it
/// ("skfem:b:wall"): the bits 1, 2 and 4 of a value are the sides 01, 12 and 02 of its triangle.
bool is_side_name(std::string_view name);

/// Whether programs write markers of points under that name of a point array ("triangle:marker", "medit:ref",
/// "vertex_markers", ...): numbers of the curves and points of the geometry that they are on. Compared by plain_name().
bool is_marker_name(std::string_view name);

/// Whether a cell array of that name divides or numbers cells for another purpose: parts of a parallel run, ghost
/// cells, cells of an older mesh. Compared by plain_name().
bool is_bookkeeping_name(std::string_view name);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/file_groups.h"

namespace trismooth {

/// The vertices that sets of the file hold.
struct HeldSets {
  std::vector<FilePointSet> sets;  ///< all that the document has, in its order, then of its implied sets what is inside
  std::vector<std::uint8_t> flags;  ///< per point: 1 where a set holds it; empty where none holds any
  std::vector<std::string> notes;   ///< what the user should know, one sentence each
};

/// In place of names of sets: no set holds vertices.
inline constexpr std::string_view no_sets = "none";

/// Whether `names` is no_sets alone. Throws std::invalid_argument where it is there with others.
bool holds_no_sets(std::span<const std::string> names);

/// The document's point sets that hold their vertices: those of `names`, or where that is empty all but those that are
/// of an area. `names` may be no_sets alone. A set is of an area if it has a vertex inside the mesh (each of its
/// neighbours is in two of its elements) and all the neighbours of this: files name the points of whole parts, and
/// mean nothing by it that a smoother must obey. Notes name these, and sets without points.
///
/// The document's implied sets are sets of those of their points that are inside the mesh, of no line or point cell
/// and of one of `regions` alone (a number a triangle; empty: no one has told them);
/// what else they have is held anyway, unless vertices slide: then that of points of the geometry has all of its
/// points. They are never of an area, and there are none without points.
///
/// What point arrays of markers (is_marker_name(), whole numbers) mark inside the mesh is an implied set of the array's
/// name (see find_marked_points()), and a note tells of it.
///
/// "ARRAY=NUMBER" in `names` is the set of what points_of_label() has, which is never of an area.
///
/// `elements`: of the document. Throws std::invalid_argument for a name that no set has and for a label that nothing
/// has, with some of those there are.
/// Complexity: n log n in the members of all sets and the elements around them.
HeldSets find_held_sets(const MeshDocument& document, const ElementList& elements,
                        std::span<const std::string> names = {}, std::span<const std::int32_t> regions = {},
                        bool slides = false);

/// The document's cell sets. Complexity: n log n in their members.
std::vector<FileCellSet> summarise_cell_sets(const MeshDocument& document);

}  // namespace trismooth

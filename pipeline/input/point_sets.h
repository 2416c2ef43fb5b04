#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/file_groups.h"

namespace trismooth {

/// The vertices that sets of the file hold.
struct HeldSets {
  std::vector<FilePointSet> sets;   ///< all that the document has, in its order
  std::vector<std::uint8_t> flags;  ///< per point: 1 where a set holds it; empty where none holds any
  std::vector<std::string> notes;   ///< what the user should know, one sentence each
};

/// In place of names of sets: no set holds vertices.
inline constexpr std::string_view no_sets = "none";

/// The document's point sets that hold their vertices: those of `names`, or where that is empty all but those that are
/// of an area. `names` may be no_sets alone. A set is of an area if it has a vertex inside the mesh (each of its
/// neighbours is in two of its triangles) and all the neighbours of this: files name the points of whole parts, and
/// mean nothing by it that a smoother must obey. A note names these.
///
/// `triangles`: of the document. Throws std::invalid_argument for a name that no set has, with those there are.
/// Complexity: n log n in the members of all sets and the triangles around them.
HeldSets find_held_sets(const MeshDocument& document, std::span<const Triangle> triangles,
                        std::span<const std::string> names = {});

/// The document's cell sets. Complexity: n log n in their members.
std::vector<FileCellSet> summarise_cell_sets(const MeshDocument& document);

}  // namespace trismooth

#pragma once

#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The points inside the mesh that carry a marker other than what surrounds them, a set for each array of markers that
/// has any: electrodes, points and segments that a mesh generator was told to respect. Arrays of markers are those
/// that readers make of Triangle's markers and of Medit's and FreeFem's numbers of vertices, and that keep their names
/// in files of other formats ("triangle:marker", "medit:ref", "freefem:label"), of whole numbers and one component.
///
/// What surrounds is 0, where any point inside has it, for that is what programs write where there is nothing to say;
/// else what most points inside have. In Triangle's markers each other value is a mark. Elsewhere whole parts may have
/// a number of their own, which is none: a point all of whose neighbours have its value marks nothing, nor do these. An
/// array that numbers its points (more than half of those inside would be marks, and most of them of different values)
/// marks nothing.
///
/// `triangles`: of the document. A point is inside where each neighbour is in two of its triangles. Complexity: linear
/// in points and triangles where there is such an array, and n log n in the points it marks.
std::vector<NamedSet> find_marked_points(const MeshDocument& document, std::span<const Triangle> triangles);

}  // namespace trismooth

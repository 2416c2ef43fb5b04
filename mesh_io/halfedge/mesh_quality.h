// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/halfedge/open_mesh_view.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// What quality() does with a mesh that is viewed.
[[nodiscard]] QualityReport open_mesh_quality(const ConstOpenMeshView& mesh, const QualityOptions& options);

/// The quality of an OpenMesh mesh, which is read and left as it is: of any type that smooth() takes, const ones as
/// well, in any plane. Faces may run either way round: what the majority of a component's faces is counts as positive,
/// and only faces that are negative then are inverted. The report is of the faces of three and four sides; those of
/// more have a say in the plane alone. Deleted faces are passed over; WorstElement::element is a face by its idx().
/// Lengths and areas are in the units of the points. So are the centroids of the worst elements, in the two coordinates
/// along which the mesh lies; in a tilted plane along two axes in it.
///
/// Throws std::invalid_argument for a face of fewer than three sides and for a number of threads out of range;
/// MeshError for a component that cannot be oriented, for a coordinate of a face that is not finite and for faces that
/// lie in no plane. Complexity: linear, but for sorting the edges of each vertex. The report is the same to the bit for
/// every number of threads, and for points along two coordinate axes that of flat arrays.
template <class Mesh>
[[nodiscard]] QualityReport quality(const Mesh& mesh, const QualityOptions& options = {}) {
  return open_mesh_quality(open_mesh::view_of<ConstOpenMeshView>(mesh), options);
}

}  // namespace trismooth

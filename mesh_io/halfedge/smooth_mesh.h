#pragma once

#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth {

/// Smooths a halfedge mesh of the caller's in place: its points move within the plane in which they lie. Boundary
/// vertices are fixed, and what `constraints` names (one region a face, one flag a vertex). Components may be oriented
/// either way. With Topology::device the options' backend finds the rings, else they come from the halfedges.
///
/// The vertices of faces and of other cells must lie in a plane, in any direction: to within 1e-6 of their extent, and
/// to within a tenth of the size of the smallest face at the vertex. Each keeps its small offset from the plane. Throws
/// MeshError where they do not, or where a coordinate is not finite, in space or along the plane; std::invalid_argument
/// for options and constraints that do not fit and for a mesh with deleted elements (call garbage_collection() first).
/// The mesh is untouched then. Complexity: linear beside the sweeps.
SmoothingResult smooth(TriangleMesh& mesh, const Constraints& constraints, const SmoothingOptions& options);

/// The same without constraints.
SmoothingResult smooth(TriangleMesh& mesh, const SmoothingOptions& options = {});

}  // namespace trismooth

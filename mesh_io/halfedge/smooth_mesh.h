#pragma once

#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth {

/// Smooths a halfedge mesh of the caller's in place: its points move within the plane in which they lie. Boundary
/// vertices are fixed, and what `constraints` names (one region a face, one flag a vertex). Components may be oriented
/// either way. With Topology::device the options' backend finds the rings, else they come from the halfedges. Throws
/// MeshError where the vertices of faces and other cells do not lie in a plane (see fit_plane()) or are not finite,
/// there or in it,
/// std::invalid_argument for options and constraints that do not fit and for a mesh with deleted elements (call
/// garbage_collection() first).
SmoothingResult smooth(TriangleMesh& mesh, const Constraints& constraints, const SmoothingOptions& options);

/// The same without constraints.
SmoothingResult smooth(TriangleMesh& mesh, const SmoothingOptions& options = {});

}  // namespace trismooth

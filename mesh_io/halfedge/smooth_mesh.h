// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <vector>

#include "trismooth/mesh_io/halfedge/mesh_constraints.h"
#include "trismooth/mesh_io/halfedge/open_mesh_view.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// An OpenMesh mesh whose connectivity is analysed once and whose points are smoothed as often as they change (moving
/// meshes). `Mesh` is any type with an array kernel, TriMesh_ArrayKernelT or PolyMesh_ArrayKernelT, with traits of the
/// caller's: points of two or three numbers of float or double (OpenMesh's vectors, Eigen's, or any type with
/// operator[] and OpenMesh::vector_traits). Faces run either way round in each component.
///
/// Faces of three and four sides are elements, triangles and quadrilaterals, which are smoothed together, whatever the
/// method. The corners of a face of five sides or more are held (hold::other_cell), as those of other cells are;
/// mesh.triangulate(face) makes triangles of it, which are smoothed.
///
/// The vertices of faces and of other cells lie in a plane, in any direction: to within 1e-6 of their extent, and to
/// within a tenth of the size of the smallest face at the vertex. Points move within the plane, and each keeps its
/// small offset from it, but where free vertices far off had a say in the plane: they come home into that of the
/// others. Points of two numbers, and those that lie along two coordinate axes exactly, are smoothed where they are, to
/// the bits of flat arrays.
///
/// Held are boundaries, what the constraints name, and what the mesh says by its status, where it has one: vertices
/// that are locked or features, the ends of edges and halfedges that are, and the corners of locked faces. Deleted
/// elements are passed over. A deleted vertex, and one without a face, may be anywhere, at NaN as well. Nothing of the
/// mesh changes but the points of vertices that move. Numbers of elements in results are those of faces, deleted ones
/// counted; places of vertices that went back are in the two coordinates along which the mesh lies, in a tilted plane
/// along two axes in it.
///
/// Owns copies of all it needs; the mesh may go, but for options.mean_ratio.target_lengths (one a vertex of the mesh),
/// which stay the caller's and are read in every smooth(). A plan that has been moved from can only be assigned to and
/// destroyed, its smooth() throws std::logic_error. One thread at a time may use a plan; several plans may be used at
/// the same time. With a backend that runs on a device: from threads that have the same device current.
class [[nodiscard]] MeshPlan {
 public:
  /// Reads connectivity, status and constraints. Throws std::invalid_argument for a face of fewer than three sides and
  /// for options and constraints that do not fit, MeshError for a component that cannot be oriented, DeviceError.
  /// Complexity: linear, but for sorting the edges of each vertex.
  template <class Mesh>
  MeshPlan(const Mesh& mesh, const MeshConstraints& constraints, const SmoothingOptions& options = {})
      : MeshPlan(open_mesh::view_of<ConstOpenMeshView>(mesh), constraints, options) {}
  /// A plan without constraints: fixed is what the mesh itself holds.
  template <class Mesh>
  requires(!std::same_as<Mesh, MeshPlan>) explicit MeshPlan(const Mesh& mesh, const SmoothingOptions& options = {})
      : MeshPlan(mesh, MeshConstraints{}, options) {}
  /// A plan of a mesh that is viewed already.
  MeshPlan(const ConstOpenMeshView& mesh, const MeshConstraints& constraints, const SmoothingOptions& options);
  MeshPlan(MeshPlan&&) noexcept;
  MeshPlan& operator=(MeshPlan&&) noexcept;
  ~MeshPlan();

  /// Smooths the points of the mesh in place: of that from which the plan was made, or of any other with that
  /// connectivity. Vertices that do not move keep their bits. Where the points lie along two coordinate axes the first
  /// call also orders the mesh in memory, and a later one repeats that only if the majority orientation of a component
  /// has changed; in other planes every call does. Throws std::invalid_argument for a mesh with other vertices or
  /// faces, for one in a tilted plane where vertices are to slide, for target lengths that do not fit, and for
  /// quadrilaterals where the backend smooths triangles alone, MeshError for a coordinate of a used vertex that is not
  /// finite, in space or along the plane, and for points that lie in no plane, DeviceError; the points are untouched
  /// then. Complexity: linear in each sweep and never more than the vertices whose neighbourhood changed; n log n where
  /// the mesh is ordered.
  template <class Mesh>
  SmoothingResult smooth(Mesh& mesh) {
    return smooth_view(open_mesh::view_of<OpenMeshView>(mesh));
  }

  /// Why each vertex is held, deleted ones counted: bits of namespace hold (base/hold.h), 0 where nothing holds it.
  /// What the status of the mesh holds is `named`, as is what is flat on purpose, which is known after the first
  /// smooth(). Throws std::logic_error where the plan has been moved from. Complexity: linear.
  [[nodiscard]] std::vector<std::uint8_t> fixed() const;

 private:
  friend SmoothingResult smooth_open_mesh(const OpenMeshView& mesh, const MeshConstraints& constraints,
                                          const SmoothingOptions& options);
  SmoothingResult smooth_view(const OpenMeshView& mesh);

  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// What smooth() does with a mesh that is viewed.
SmoothingResult smooth_open_mesh(const OpenMeshView& mesh, const MeshConstraints& constraints,
                                 const SmoothingOptions& options);

/// As a function: `auto p = plan(mesh, constraints, options); p.smooth(mesh);`
template <class Mesh>
MeshPlan plan(const Mesh& mesh, const MeshConstraints& constraints, const SmoothingOptions& options = {}) {
  return {open_mesh::view_of<ConstOpenMeshView>(mesh), constraints, options};
}
/// plan() without constraints: fixed is what the mesh itself holds.
template <class Mesh>
MeshPlan plan(const Mesh& mesh, const SmoothingOptions& options = {}) {
  return {open_mesh::view_of<ConstOpenMeshView>(mesh), MeshConstraints{}, options};
}

/// Smooths a mesh in place, once: plan(mesh, constraints, options).smooth(mesh). For arguments, errors and guarantees
/// see MeshPlan.
template <class Mesh>
SmoothingResult smooth(Mesh& mesh, const MeshConstraints& constraints, const SmoothingOptions& options = {}) {
  return smooth_open_mesh(open_mesh::view_of<OpenMeshView>(mesh), constraints, options);
}
/// smooth() without constraints: fixed is what the mesh itself holds.
template <class Mesh>
SmoothingResult smooth(Mesh& mesh, const SmoothingOptions& options = {}) {
  return smooth_open_mesh(open_mesh::view_of<OpenMeshView>(mesh), MeshConstraints{}, options);
}

}  // namespace trismooth

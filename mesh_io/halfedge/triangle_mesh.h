// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

// OpenMesh's Eigen traits need its own vector traits before them.
// clang-format off
#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// OpenMesh with double coordinates and Eigen vectors as points.
struct TriangleMeshTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};

/// The halfedge mesh of this project, whose faces have three sides or four.
using ElementMesh = OpenMesh::PolyMesh_ArrayKernelT<TriangleMeshTraits>;

/// A mesh of triangles alone, with all that OpenMesh does with these.
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<TriangleMeshTraits>;

/// The faces of a mesh of triangles as a list, in their order: three vertex indices each, as the face runs. Throws
/// std::invalid_argument for a face that is no triangle. Linear.
std::vector<Triangle> face_list(const OpenMesh::PolyConnectivity& mesh);

}  // namespace trismooth

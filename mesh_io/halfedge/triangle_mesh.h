#pragma once

// OpenMesh's Eigen traits need its own vector traits before them.
// clang-format off
#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

namespace trismooth {

/// OpenMesh with double coordinates and Eigen vectors as points.
struct TriangleMeshTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};

/// The halfedge mesh of this project.
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<TriangleMeshTraits>;

}  // namespace trismooth

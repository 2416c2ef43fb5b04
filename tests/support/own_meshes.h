// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <random>
#include <string>
#include <vector>

// OpenMesh's Eigen traits need its own vector traits before them.
// clang-format off
#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

#include "support/planar_samples.h"

/// OpenMesh meshes with traits as programs of other people have them.
namespace own_meshes {

/// A point that is no vector of anybody's library, with something behind its numbers.
struct Node {
  using vector_type = Node;
  using value_type = double;
  static constexpr std::size_t size_ = 2;

  double x = 0;
  double y = 0;
  std::int64_t tag = 77;

  double operator[](std::size_t k) const { return k == 0 ? x : y; }
  double& operator[](std::size_t k) { return k == 0 ? x : y; }
};

template <class PointType>
struct PointTraits : OpenMesh::DefaultTraits {
  using Point = PointType;
};

/// With all that a program may add.
struct FullTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Color);
  VertexTraits { int bc = 0; };
  FaceTraits { int material = 0; };
};

struct EigenTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector2f;
  using Normal = Eigen::Vector3f;
};

using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using FullMesh = OpenMesh::TriMesh_ArrayKernelT<FullTraits>;
using PairMesh = OpenMesh::TriMesh_ArrayKernelT<PointTraits<OpenMesh::Vec2d>>;
using EigenMesh = OpenMesh::TriMesh_ArrayKernelT<EigenTraits>;
using NodeMesh = OpenMesh::TriMesh_ArrayKernelT<PointTraits<Node>>;
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
using FullPolyMesh = OpenMesh::PolyMesh_ArrayKernelT<FullTraits>;
using PairPolyMesh = OpenMesh::PolyMesh_ArrayKernelT<PointTraits<OpenMesh::Vec2d>>;
using EigenPolyMesh = OpenMesh::PolyMesh_ArrayKernelT<EigenTraits>;
using NodePolyMesh = OpenMesh::PolyMesh_ArrayKernelT<PointTraits<Node>>;

using Point3 = std::array<double, 3>;

/// Into a plane along no two coordinate axes; (-0.36, -0.48, 0.8) is across it.
inline Point3 tilted(const Point3& p) {
  return {0.48 * p[0] - 0.8 * p[1] + 3, 0.64 * p[0] + 0.6 * p[1] - 5, 0.6 * p[0] + 1};
}

/// n x n squares in no order.
inline planar_samples::Sample shuffled_grid(std::int32_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  return planar_samples::shuffled(planar_samples::grid(n, 0.4, random), random);
}

template <class Mesh>
using NumberOf = typename OpenMesh::vector_traits<typename Mesh::Point>::value_type;
template <class Mesh>
inline constexpr std::size_t numbers_of = OpenMesh::vector_traits<typename Mesh::Point>::size_;

/// Faces of any number of corners through add_face(), each point where `place` puts it: as many numbers as the mesh
/// takes.
template <class Mesh, class Faces, class Place>
Mesh mesh_of(const std::vector<double>& xyz, const Faces& faces, const Place& place) {
  Mesh mesh;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const auto placed = place(std::array{xyz[i], xyz[i + 1], xyz[i + 2]});
    typename Mesh::Point point;
    for (std::size_t k = 0; k < numbers_of<Mesh>; ++k) {
      point[k] = static_cast<NumberOf<Mesh>>(placed[k]);
    }
    mesh.add_vertex(point);
  }
  for (const auto& face : faces) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const std::int32_t corner : face) {
      corners.push_back(mesh.vertex_handle(static_cast<unsigned>(corner)));
    }
    mesh.add_face(corners);
  }
  return mesh;
}

template <class Mesh, class Place>
Mesh mesh_of(const planar_samples::Sample& sample, const Place& place) {
  return mesh_of<Mesh>(sample.xyz, sample.triangles, place);
}

template <class Mesh>
Mesh mesh_of(const planar_samples::Sample& sample) {
  return mesh_of<Mesh>(sample, [](const Point3& p) { return p; });
}

/// x and y of the sample, as the mesh stores them.
template <class Number>
std::vector<Number> xy_of(const planar_samples::Sample& sample) {
  const std::vector<double> xy = sample.xy();
  return {xy.begin(), xy.end()};
}

/// All numbers of all points, deleted ones as well.
template <class Mesh>
std::vector<NumberOf<Mesh>> numbers_in(const Mesh& mesh) {
  std::vector<NumberOf<Mesh>> numbers;
  for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
    for (std::size_t k = 0; k < numbers_of<Mesh>; ++k) {
      numbers.push_back(mesh.point(OpenMesh::VertexHandle(v))[k]);
    }
  }
  return numbers;
}

/// The first two of each.
template <class Mesh>
std::vector<NumberOf<Mesh>> xy_in(const Mesh& mesh) {
  std::vector<NumberOf<Mesh>> numbers;
  for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
    numbers.push_back(mesh.point(OpenMesh::VertexHandle(v))[0]);
    numbers.push_back(mesh.point(OpenMesh::VertexHandle(v))[1]);
  }
  return numbers;
}

/// What the exception says that `body` ends in; empty: it does not.
template <class Body>
std::string error_of(const Body& body) {
  try {
    body();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// All that a mesh knows but its points: connectivity, status bits, names of properties.
template <class Mesh>
std::vector<std::string> all_but_points(const Mesh& mesh) {
  std::vector<std::string> known{std::to_string(mesh.n_vertices()), std::to_string(mesh.n_faces())};
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    const OpenMesh::HalfedgeHandle half(h);
    for (const int index :
         {mesh.to_vertex_handle(half).idx(), mesh.face_handle(half).idx(), mesh.next_halfedge_handle(half).idx(),
          mesh.has_halfedge_status() ? static_cast<int>(mesh.status(half).bits()) : -1}) {
      known.push_back(std::to_string(index));
    }
  }
  const auto add = [&](const auto& handle, bool has_status, int reference) {
    known.push_back(std::to_string(reference) + (has_status ? " " + std::to_string(mesh.status(handle).bits()) : ""));
  };
  for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
    const OpenMesh::VertexHandle handle(v);
    add(handle, mesh.has_vertex_status(), mesh.halfedge_handle(handle).idx());
  }
  for (int e = 0; e < static_cast<int>(mesh.n_edges()); ++e) {
    add(OpenMesh::EdgeHandle(e), mesh.has_edge_status(), e);
  }
  for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
    const OpenMesh::FaceHandle handle(f);
    add(handle, mesh.has_face_status(), mesh.halfedge_handle(handle).idx());
  }
  const auto add_names = [&](auto begin, auto end) {
    for (auto property = begin; property != end; ++property) {
      known.push_back(*property == nullptr ? std::string("none")
                                           : (*property)->name() + " " + std::to_string((*property)->n_elements()));
    }
  };
  add_names(mesh.vprops_begin(), mesh.vprops_end());
  add_names(mesh.hprops_begin(), mesh.hprops_end());
  add_names(mesh.eprops_begin(), mesh.eprops_end());
  add_names(mesh.fprops_begin(), mesh.fprops_end());
  return known;
}

}  // namespace own_meshes

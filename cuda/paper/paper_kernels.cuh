// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/paper/mesh_layouts.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/methods/laplacian.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

/// The parts that the paper's two versions are made of, over either layout.
namespace trismooth::cuda {

/// Calls `function` with the one-ring update of a method of the paper. The others are refused where options are
/// checked.
template <class Function>
void visit_paper_method(Method method, const Function& function) {
  if (method == Method::laplacian) {
    function(Laplacian{});
  } else {
    function(SmartLaplacian{});
  }
}

/// The positions of a vertex's neighbours as an update reads them, straight from the mesh.
template <class Mesh>
struct NeighbourPositions {
  const Mesh& mesh;
  const std::int32_t* neighbours;
  std::int32_t count;
  std::int32_t buffer;

  __device__ NeighbourPositions(const Mesh& of, std::int32_t vertex, std::int32_t from)
      : mesh(of), neighbours(of.neighbours(vertex)), count(of.neighbour_count(vertex)), buffer(from) {}
  __device__ int size() const { return count; }
  __device__ Point2<typename Mesh::Scalar> operator[](int i) const { return mesh.load(neighbours[i], buffer); }
  __device__ std::int32_t number(int i) const { return neighbours[i]; }
};

/// Updates one free vertex by its stored minimum quality: the smoothed position, the temporary re-evaluation of its
/// elements there, and the decision between the two.
template <class Update, class Mesh, class T = typename Mesh::Scalar>
__device__ void relocate(const Update& method, const Mesh& mesh, std::int32_t v, std::int32_t from, std::int32_t to,
                         double tolerance, SweepTally<T>& tally) {
  const NeighbourPositions<Mesh> ring(mesh, v, from);
  const Point2<T> position = mesh.load(v, from);
  const VertexMove<T> result =
      with_squares(update_with_minimum(method, v, position, ring, mesh.min_quality(v)), position, ring);
  ++tally.evaluated;
  mesh.store(v, to, result.move.position);
  if (result.move.moved) {
    add_move(tally, length_of_move(position, result.move.position, ring.size(), result.squares),
             static_cast<T>(tolerance));
  }
}

/// The qualities of a vertex's elements and the smallest of them, without the use of stored ones.
template <class Mesh>
__device__ typename Mesh::Scalar evaluated_minimum(const Mesh& mesh, std::int32_t v, std::int32_t buffer) {
  return worst_quotient(mesh.load(v, buffer), NeighbourPositions<Mesh>(mesh, v, buffer));
}

/// The smallest quality of all elements of the free vertices before `end`, by one block, into sums->min_quotient.
template <class Mesh>
__device__ void measure_in_block(const Mesh& mesh, std::int32_t end, std::int32_t buffer, SweepSums* sums) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::int32_t v = static_cast<std::int32_t>(threadIdx.x); v < end; v += static_cast<std::int32_t>(blockDim.x)) {
    const auto quotient = static_cast<double>(evaluated_minimum(mesh, v, buffer));
    smallest = quotient < smallest ? quotient : smallest;
  }
  join_min_quotient(smallest, sums);
}

/// The quality of one triangle, seen from each of its corners.
template <class Mesh>
__device__ void evaluate_triangle(const Mesh& mesh, std::int32_t t, std::int32_t buffer) {
  const TriangleVertices corners = mesh.corners(t);
  const auto a = mesh.load(corners.a, buffer);
  const auto b = mesh.load(corners.b, buffer);
  const auto c = mesh.load(corners.c, buffer);
  mesh.store_quality(t, 0, shape_quotient(a, b, c));
  mesh.store_quality(t, 1, shape_quotient(b, c, a));
  mesh.store_quality(t, 2, shape_quotient(c, a, b));
}

/// Child kernel of the CDP version, and the initiating procedure's: the quality of all triangles, a thread each.
template <class Mesh>
__global__ void update_triangle_qualities(Mesh mesh, std::int32_t buffer) {
  const std::int64_t t = thread_index();
  if (t < mesh.triangle_count) {
    evaluate_triangle(mesh, static_cast<std::int32_t>(t), buffer);
  }
}

/// Child kernel of the CDP version, and the initiating procedure's: the smallest stored quality of the elements of each
/// vertex, a thread each.
template <class Mesh>
__global__ void update_vertex_minima(Mesh mesh) {
  using T = typename Mesh::Scalar;
  const std::int64_t i = thread_index();
  if (i < mesh.vertex_count) {
    const auto v = static_cast<std::int32_t>(i);
    T smallest = 1;  // no quotient is above 1 / (2 sqrt(3))
    const std::uint32_t* const elements = mesh.elements(v);
    for (std::int32_t e = 0; e < mesh.element_count(v); ++e) {
      const T quality = mesh.quality(elements[e]);
      smallest = quality < smallest ? quality : smallest;
    }
    mesh.store_min_quality(v, smallest);
  }
}

}  // namespace trismooth::cuda

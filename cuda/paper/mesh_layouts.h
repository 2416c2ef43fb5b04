// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/smoothing/options.h"

/// The paper's mesh data structures (its listing 1) in both layouts: coordinates, number and indices of neighbouring
/// vertices, number and indices of incident elements, boundary flag and minimum quality of each vertex; vertices and
/// quality of each triangle; the numbers of both. Indices lie in pools, since rings have any size; a vertex knows where
/// its own begin. Two things are beyond the listing: the second buffer of coordinates that Form A writes into, and one
/// quality for each corner of a triangle, since rounding depends on the corner that the evaluation begins with.
///
/// The views have one interface, so that every kernel is written once. They are trivially copyable and own nothing.
namespace trismooth::cuda {

/// The three vertices of a triangle, counter-clockwise.
struct TriangleVertices {
  std::int32_t a;
  std::int32_t b;
  std::int32_t c;
};

/// A vertex of the array of structures: one sector of 32 bytes in float.
template <class T>
struct alignas(sizeof(T) == sizeof(float) ? 32 : 16) VertexRecord {
  T x;
  T y;
  T min_quality;
  std::int32_t neighbour_count;
  std::uint32_t neighbours;  ///< where they begin in the pool
  std::int32_t element_count;
  std::uint32_t elements;  ///< where they begin in the pool
  bool boundary;
};
static_assert(sizeof(VertexRecord<float>) == 32 && alignof(VertexRecord<float>) == 32);
static_assert(offsetof(VertexRecord<float>, x) == 0 && offsetof(VertexRecord<float>, y) == 4 &&
              offsetof(VertexRecord<float>, min_quality) == 8 && offsetof(VertexRecord<float>, neighbour_count) == 12 &&
              offsetof(VertexRecord<float>, neighbours) == 16 && offsetof(VertexRecord<float>, element_count) == 20 &&
              offsetof(VertexRecord<float>, elements) == 24 && offsetof(VertexRecord<float>, boundary) == 28);
static_assert(sizeof(VertexRecord<double>) == 48 && alignof(VertexRecord<double>) == 16);
static_assert(offsetof(VertexRecord<double>, x) == 0 && offsetof(VertexRecord<double>, y) == 8 &&
              offsetof(VertexRecord<double>, min_quality) == 16 &&
              offsetof(VertexRecord<double>, neighbour_count) == 24 &&
              offsetof(VertexRecord<double>, neighbours) == 28 && offsetof(VertexRecord<double>, element_count) == 32 &&
              offsetof(VertexRecord<double>, elements) == 36 && offsetof(VertexRecord<double>, boundary) == 40);

/// A triangle of the array of structures.
template <class T>
struct alignas(8) TriangleRecord {
  TriangleVertices vertices;
  T quality[3];  ///< seen from each corner
};
static_assert(sizeof(TriangleRecord<float>) == 24 && alignof(TriangleRecord<float>) == 8);
static_assert(offsetof(TriangleRecord<float>, vertices) == 0 && offsetof(TriangleRecord<float>, quality) == 12);
static_assert(sizeof(TriangleRecord<double>) == 40 && alignof(TriangleRecord<double>) == 8);
static_assert(offsetof(TriangleRecord<double>, vertices) == 0 && offsetof(TriangleRecord<double>, quality) == 16);

/// Array of structures.
template <class T>
struct MeshAoS {
  using Scalar = T;

  std::int32_t vertex_count;
  std::int32_t triangle_count;
  VertexRecord<T>* vertices;
  TriangleRecord<T>* triangles;
  PointRecord<T>* second_buffer;
  const std::int32_t* neighbour_pool;  ///< vertices, in ring order
  const std::uint32_t* element_pool;   ///< corners: 3 t + i is corner i of triangle t; in ring order

  TRISMOOTH_HOST_DEVICE Point2<T> load(std::int32_t v, std::int32_t buffer) const {
    if (buffer == 0) {
      return {vertices[v].x, vertices[v].y};
    }
    const PointRecord<T> record = second_buffer[v];
    return {record.x, record.y};
  }
  TRISMOOTH_HOST_DEVICE void store(std::int32_t v, std::int32_t buffer, Point2<T> point) const {
    if (buffer == 0) {
      vertices[v].x = point.x;
      vertices[v].y = point.y;
    } else {
      second_buffer[v] = PointRecord<T>{point.x, point.y};
    }
  }
  TRISMOOTH_HOST_DEVICE T min_quality(std::int32_t v) const { return vertices[v].min_quality; }
  TRISMOOTH_HOST_DEVICE void store_min_quality(std::int32_t v, T quality) const { vertices[v].min_quality = quality; }
  TRISMOOTH_HOST_DEVICE bool is_boundary(std::int32_t v) const { return vertices[v].boundary; }
  TRISMOOTH_HOST_DEVICE std::int32_t neighbour_count(std::int32_t v) const { return vertices[v].neighbour_count; }
  TRISMOOTH_HOST_DEVICE const std::int32_t* neighbours(std::int32_t v) const {
    return neighbour_pool + vertices[v].neighbours;
  }
  TRISMOOTH_HOST_DEVICE std::int32_t element_count(std::int32_t v) const { return vertices[v].element_count; }
  TRISMOOTH_HOST_DEVICE const std::uint32_t* elements(std::int32_t v) const {
    return element_pool + vertices[v].elements;
  }
  /// The initiating procedure's part for one vertex.
  TRISMOOTH_HOST_DEVICE void initiate(std::int32_t v, std::int32_t ring_size, std::uint32_t ring_begin,
                                      bool boundary) const {
    vertices[v].min_quality = 0;
    vertices[v].neighbour_count = ring_size;
    vertices[v].neighbours = ring_begin;
    vertices[v].element_count = ring_size;
    vertices[v].elements = ring_begin;
    vertices[v].boundary = boundary;
  }
  TRISMOOTH_HOST_DEVICE TriangleVertices corners(std::int32_t t) const { return triangles[t].vertices; }
  TRISMOOTH_HOST_DEVICE void store_corners(std::int32_t t, TriangleVertices corners) const {
    triangles[t].vertices = corners;
  }
  TRISMOOTH_HOST_DEVICE T quality(std::uint32_t corner) const { return triangles[corner / 3].quality[corner % 3]; }
  TRISMOOTH_HOST_DEVICE void store_quality(std::int32_t t, std::int32_t i, T quality) const {
    triangles[t].quality[i] = quality;
  }
};

/// Structure of arrays.
template <class T>
struct MeshSoA {
  using Scalar = T;

  std::int32_t vertex_count;
  std::int32_t triangle_count;
  T* x;
  T* y;
  T* second_x;
  T* second_y;
  T* vertex_min_quality;
  std::int32_t* neighbour_counts;
  std::uint32_t* neighbour_begins;
  std::int32_t* element_counts;
  std::uint32_t* element_begins;
  bool* boundary;
  std::int32_t* triangle_vertices;  ///< corner i of triangle t at i triangle_count + t
  T* triangle_quality;              ///< of corner i of triangle t at i triangle_count + t
  const std::int32_t* neighbour_pool;
  const std::uint32_t* element_pool;

  TRISMOOTH_HOST_DEVICE Point2<T> load(std::int32_t v, std::int32_t buffer) const {
    return buffer == 0 ? Point2<T>{x[v], y[v]} : Point2<T>{second_x[v], second_y[v]};
  }
  TRISMOOTH_HOST_DEVICE void store(std::int32_t v, std::int32_t buffer, Point2<T> point) const {
    (buffer == 0 ? x : second_x)[v] = point.x;
    (buffer == 0 ? y : second_y)[v] = point.y;
  }
  TRISMOOTH_HOST_DEVICE T min_quality(std::int32_t v) const { return vertex_min_quality[v]; }
  TRISMOOTH_HOST_DEVICE void store_min_quality(std::int32_t v, T quality) const { vertex_min_quality[v] = quality; }
  TRISMOOTH_HOST_DEVICE bool is_boundary(std::int32_t v) const { return boundary[v]; }
  TRISMOOTH_HOST_DEVICE std::int32_t neighbour_count(std::int32_t v) const { return neighbour_counts[v]; }
  TRISMOOTH_HOST_DEVICE const std::int32_t* neighbours(std::int32_t v) const {
    return neighbour_pool + neighbour_begins[v];
  }
  TRISMOOTH_HOST_DEVICE std::int32_t element_count(std::int32_t v) const { return element_counts[v]; }
  TRISMOOTH_HOST_DEVICE const std::uint32_t* elements(std::int32_t v) const { return element_pool + element_begins[v]; }
  TRISMOOTH_HOST_DEVICE void initiate(std::int32_t v, std::int32_t ring_size, std::uint32_t ring_begin,
                                      bool is_on_boundary) const {
    vertex_min_quality[v] = 0;
    neighbour_counts[v] = ring_size;
    neighbour_begins[v] = ring_begin;
    element_counts[v] = ring_size;
    element_begins[v] = ring_begin;
    boundary[v] = is_on_boundary;
  }
  TRISMOOTH_HOST_DEVICE TriangleVertices corners(std::int32_t t) const {
    return {triangle_vertices[t], triangle_vertices[at(1) + t], triangle_vertices[at(2) + t]};
  }
  TRISMOOTH_HOST_DEVICE void store_corners(std::int32_t t, TriangleVertices corners) const {
    triangle_vertices[t] = corners.a;
    triangle_vertices[at(1) + t] = corners.b;
    triangle_vertices[at(2) + t] = corners.c;
  }
  TRISMOOTH_HOST_DEVICE T quality(std::uint32_t corner) const {
    return triangle_quality[at(static_cast<std::int32_t>(corner % 3)) + corner / 3];
  }
  TRISMOOTH_HOST_DEVICE void store_quality(std::int32_t t, std::int32_t i, T quality) const {
    triangle_quality[at(i) + t] = quality;
  }

 private:
  TRISMOOTH_HOST_DEVICE std::size_t at(std::int32_t i) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(triangle_count);
  }
};
static_assert(offsetof(MeshSoA<float>, x) == 8 && offsetof(MeshSoA<float>, y) == 16 &&
              offsetof(MeshSoA<float>, vertex_min_quality) == 40 && offsetof(MeshSoA<float>, boundary) == 80 &&
              offsetof(MeshSoA<float>, triangle_vertices) == 88 && offsetof(MeshSoA<float>, triangle_quality) == 96);

/// The view of a layout by name.
template <class T, Layout layout>
struct MeshOf;
template <class T>
struct MeshOf<T, Layout::aos> {
  using View = MeshAoS<T>;
};
template <class T>
struct MeshOf<T, Layout::soa> {
  using View = MeshSoA<T>;
};
template <class T, Layout layout>
using MeshView = typename MeshOf<T, layout>::View;

/// Instantiates a function that launches an execution of the paper, for all views.
#define TRISMOOTH_INSTANTIATE_FOR_PAPER(launch)                                                                 \
  template void launch(Method, const MeshAoS<float>&, const LoopRules&, LoopState*, SweepSums*, cudaStream_t);  \
  template void launch(Method, const MeshSoA<float>&, const LoopRules&, LoopState*, SweepSums*, cudaStream_t);  \
  template void launch(Method, const MeshAoS<double>&, const LoopRules&, LoopState*, SweepSums*, cudaStream_t); \
  template void launch(Method, const MeshSoA<double>&, const LoopRules&, LoopState*, SweepSums*, cudaStream_t)

}  // namespace trismooth::cuda

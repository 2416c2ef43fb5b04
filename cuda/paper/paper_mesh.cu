// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "trismooth/cuda/paper/paper_kernels.cuh"
#include "trismooth/cuda/paper/paper_mesh.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace {

/// A triangle (v, b, c) belongs to the free vertex of the smallest number.
__device__ std::int32_t owner(const RingsView& rings, std::int32_t v, std::int32_t b, std::int32_t c) {
  const std::int32_t of_v_and_b = b < rings.size && b < v ? b : v;
  return c < rings.size && c < of_v_and_b ? c : of_v_and_b;
}

__device__ std::int32_t next_in_ring(const RingsView& rings, std::int32_t v, std::int32_t i) {
  return rings.ring(v)[i + 1 == rings.ring_size(v) ? 0 : i + 1];
}

__global__ void count_owned(RingsView rings, std::uint32_t* counts) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  std::uint32_t owned = 0;
  for (std::int32_t k = 0; k < rings.ring_size(v); ++k) {
    owned += owner(rings, v, rings.ring(v)[k], next_in_ring(rings, v, k)) == v ? 1 : 0;
  }
  counts[v] = owned;
}

/// Numbers the triangles of each vertex from its offset on and writes them down.
__global__ void list_owned(RingsView rings, const std::uint32_t* offsets, TriangleVertices* triangles,
                           std::uint32_t* elements) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  std::uint32_t triangle = offsets[v];
  for (std::int32_t k = 0; k < rings.ring_size(v); ++k) {
    const std::int32_t b = rings.ring(v)[k];
    const std::int32_t c = next_in_ring(rings, v, k);
    if (owner(rings, v, b, c) == v) {
      triangles[triangle] = {v, b, c};
      elements[rings.offsets[v] + static_cast<std::uint32_t>(k)] = 3 * triangle;
      ++triangle;
    }
  }
}

/// Each vertex finds those of its triangles that belong to a neighbour, in the neighbour's ring.
__global__ void find_owned_by_others(RingsView rings, std::uint32_t* elements) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  for (std::int32_t k = 0; k < rings.ring_size(v); ++k) {
    const std::int32_t b = rings.ring(v)[k];
    const std::int32_t c = next_in_ring(rings, v, k);
    const std::int32_t w = owner(rings, v, b, c);
    if (w == v) {
      continue;
    }
    // The triangle (v, b, c) is (b, c, v) seen from b, and (c, v, b) seen from c.
    const std::int32_t after_w = w == b ? c : v;
    const std::uint32_t corner_of_v = w == b ? 2 : 1;
    for (std::int32_t slot = 0; slot < rings.ring_size(w); ++slot) {
      if (rings.ring(w)[slot] == after_w) {
        elements[rings.offsets[v] + static_cast<std::uint32_t>(k)] =
            elements[rings.offsets[w] + static_cast<std::uint32_t>(slot)] + corner_of_v;
        break;
      }
    }
  }
}

template <class Mesh>
__global__ void initiate_vertices(Mesh mesh, RingsView rings) {
  const std::int64_t i = thread_index();
  if (i >= mesh.vertex_count) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  const bool is_free = v < rings.size;
  mesh.initiate(v, is_free ? rings.ring_size(v) : 0, is_free ? rings.offsets[v] : 0, !is_free);
}

template <class Mesh>
__global__ void initiate_triangles(Mesh mesh, const TriangleVertices* triangles) {
  const std::int64_t t = thread_index();
  if (t < mesh.triangle_count) {
    mesh.store_corners(static_cast<std::int32_t>(t), triangles[t]);
  }
}

template <class Mesh, class Points>
__global__ void write_positions(Mesh mesh, Points points) {
  const std::int64_t i = thread_index();
  if (i < mesh.vertex_count) {
    const auto v = static_cast<std::int32_t>(i);
    mesh.store(v, 0, points.load(v));
    mesh.store(v, 1, points.load(v));
  }
}

template <class Mesh, class Points>
__global__ void copy_positions(Mesh mesh, std::int32_t buffer, Points points) {
  const std::int64_t i = thread_index();
  if (i < mesh.vertex_count) {
    const auto v = static_cast<std::int32_t>(i);
    points.store(v, mesh.load(v, buffer));
  }
}

/// Hands out parts of one allocation. Without memory it only counts.
class Parts {
 public:
  explicit Parts(std::uint8_t* memory) : memory_(memory) {}
  template <class T>
  void take(T*& pointer, std::size_t count) {
    constexpr std::size_t alignment = 256;
    pointer = memory_ == nullptr ? nullptr : reinterpret_cast<T*>(memory_ + size_);
    size_ += (count * sizeof(T) + alignment - 1) / alignment * alignment;
  }
  std::size_t size() const { return size_; }

 private:
  std::uint8_t* memory_;
  std::size_t size_ = 0;
};

template <class T>
std::size_t lay_out(MeshAoS<T>& mesh, std::uint8_t* memory) {
  Parts parts(memory);
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count);
  parts.take(mesh.vertices, vertices);
  parts.take(mesh.second_buffer, vertices);
  parts.take(mesh.triangles, static_cast<std::size_t>(mesh.triangle_count));
  return parts.size();
}

template <class T>
std::size_t lay_out(MeshSoA<T>& mesh, std::uint8_t* memory) {
  Parts parts(memory);
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count);
  const auto triangles = static_cast<std::size_t>(mesh.triangle_count);
  for (T** array : {&mesh.x, &mesh.y, &mesh.second_x, &mesh.second_y, &mesh.vertex_min_quality}) {
    parts.take(*array, vertices);
  }
  parts.take(mesh.neighbour_counts, vertices);
  parts.take(mesh.neighbour_begins, vertices);
  parts.take(mesh.element_counts, vertices);
  parts.take(mesh.element_begins, vertices);
  parts.take(mesh.boundary, vertices);
  parts.take(mesh.triangle_vertices, 3 * triangles);
  parts.take(mesh.triangle_quality, 3 * triangles);
  return parts.size();
}

}  // namespace

DeviceElements find_elements(Context& context, const RingsView& rings, std::size_t ring_entries) {
  DeviceElements found;
  if (rings.size == 0) {
    return found;
  }
  const unsigned blocks = blocks_for(rings.size);
  DeviceBuffer<std::uint32_t> offsets(context, static_cast<std::size_t>(rings.size) + 1);
  offsets.fill_bytes(0);
  count_owned<<<blocks, block_size, 0, context.stream()>>>(rings, offsets.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  sum_before(context, offsets.data(), std::int64_t{rings.size} + 1);
  const auto triangle_count = download(context, offsets.data() + rings.size);
  found.triangles = DeviceBuffer<TriangleVertices>(context, triangle_count);
  found.elements = DeviceBuffer<std::uint32_t>(context, ring_entries);
  list_owned<<<blocks, block_size, 0, context.stream()>>>(rings, offsets.data(), found.triangles.data(),
                                                          found.elements.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  find_owned_by_others<<<blocks, block_size, 0, context.stream()>>>(rings, found.elements.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  return found;
}

template <class T, Layout layout>
PaperMesh<T, layout>::PaperMesh(Context& context, const RingsView& rings, std::int32_t vertex_count,
                                const DeviceElements& elements) {
  view_.vertex_count = vertex_count;
  view_.triangle_count = static_cast<std::int32_t>(elements.triangles.size());
  view_.neighbour_pool = rings.neighbours;
  view_.element_pool = elements.elements.data();
  memory_ = DeviceBuffer<std::uint8_t>(context, lay_out(view_, nullptr));
  lay_out(view_, memory_.data());
  initiate_vertices<<<blocks_for(vertex_count), block_size, 0, context.stream()>>>(view_, rings);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  initiate_triangles<<<blocks_for(view_.triangle_count), block_size, 0, context.stream()>>>(view_,
                                                                                            elements.triangles.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template <class T, Layout layout>
void PaperMesh<T, layout>::initiate(Context& context, const PointArray<T>& points) {
  write_positions<<<blocks_for(view_.vertex_count), block_size, 0, context.stream()>>>(view_, points);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  update_triangle_qualities<<<blocks_for(view_.triangle_count), block_size, 0, context.stream()>>>(view_, 0);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  update_vertex_minima<<<blocks_for(view_.vertex_count), block_size, 0, context.stream()>>>(view_);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template <class T, Layout layout>
void PaperMesh<T, layout>::read_positions(Context& context, std::int32_t buffer, const PointArray<T>& points) const {
  copy_positions<<<blocks_for(view_.vertex_count), block_size, 0, context.stream()>>>(view_, buffer, points);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template class PaperMesh<float, Layout::aos>;
template class PaperMesh<float, Layout::soa>;
template class PaperMesh<double, Layout::aos>;
template class PaperMesh<double, Layout::soa>;

}  // namespace trismooth::cuda

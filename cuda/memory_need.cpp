#include "trismooth/cuda/memory_need.h"

#include <algorithm>
#include <string>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/error.h"
#include "trismooth/cuda/mesh_layouts.h"
#include "trismooth/quality/point2.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

namespace {

constexpr std::size_t point_bytes = sizeof(Point2<double>);
constexpr std::size_t index_bytes = sizeof(std::int32_t);

/// The paper's structure for `triangles` triangles, and the element lists beside it.
template <class T>
std::size_t paper_mesh_bytes(std::size_t vertices, std::size_t triangles, std::size_t ring_entries) {
  return vertices * (sizeof(VertexRecord<T>) + 2 * sizeof(PointRecord<T>)) +
         triangles * (sizeof(TriangleRecord<T>) + sizeof(Corners)) + ring_entries * index_bytes;
}

template <class T>
std::size_t engine_bytes(std::size_t vertices, std::size_t free_vertices, std::size_t ring_entries,
                         const SmoothingOptions& options) {
  if (options.execution != Execution::resident) {
    // Each free vertex meets six triangles or so, and most triangles have three of them; at the boundary fewer.
    return paper_mesh_bytes<T>(vertices, ring_entries / 2, ring_entries);
  }
  const std::size_t buffers = options.form == Form::swap ? 2 : 1;
  return buffers * (vertices * sizeof(PointRecord<T>) + free_vertices);
}

std::string mebibytes(std::size_t bytes) {
  return std::to_string((bytes + (std::size_t{1} << 20U) - 1) >> 20U) + " MiB";
}

}  // namespace

std::size_t memory_need(const MeshSize& size, const SmoothingOptions& options) {
  const auto vertices = static_cast<std::size_t>(size.vertices);
  const auto free_vertices = static_cast<std::size_t>(size.free_vertices);
  const auto ring_entries = static_cast<std::size_t>(size.ring_entries);
  const std::size_t stored = vertices * point_bytes;
  const std::size_t rings = vertices * index_bytes + ring_entries * index_bytes;
  const std::size_t sorting = vertices * (2 * sizeof(std::uint64_t) + 3 * index_bytes);
  const std::size_t packing = stored + rings + std::max(sorting, 2 * vertices * index_bytes + rings);
  const std::size_t engine = options.precision == Precision::double_precision
                                 ? engine_bytes<double>(vertices, free_vertices, ring_entries, options)
                                 : engine_bytes<float>(vertices, free_vertices, ring_entries, options);
  const std::size_t guard = 2 * free_vertices;
  const std::size_t smoothing = stored + vertices * (point_bytes + index_bytes) + rings + engine + guard;
  return std::max(packing, smoothing);
}

std::size_t topology_memory_need(std::int64_t vertices, std::int64_t triangles) {
  // A vertex: where its corners begin, and its flags. A triangle: three corners, its component, its orientation.
  return static_cast<std::size_t>(vertices) * (index_bytes + 1) +
         static_cast<std::size_t>(triangles) * (4 * index_bytes + 1);
}

void require_memory(std::size_t bytes) {
  std::size_t free_bytes = 0;
  std::size_t total_bytes = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemGetInfo(&free_bytes, &total_bytes));
  if (bytes > free_bytes) {
    throw DeviceError("CUDA: cudaErrorMemoryAllocation: this mesh needs about " + mebibytes(bytes) +
                      " of device memory, and the device has " + mebibytes(free_bytes) + " free of " +
                      mebibytes(total_bytes) + "; use a device with more memory, or '--backend cpu'");
  }
}

}  // namespace trismooth::cuda

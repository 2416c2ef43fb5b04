#include "trismooth/cuda/runtime/memory_need.h"

#include <algorithm>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/paper/mesh_layouts.h"

namespace trismooth::cuda {

namespace {

constexpr std::size_t point_bytes = sizeof(Point2<double>);
constexpr std::size_t index_bytes = sizeof(std::int32_t);

/// The paper's structure, and the element lists beside it.
template <class T>
std::size_t paper_mesh_bytes(std::size_t vertices, std::size_t ring_entries) {
  // A triangle has up to three places in the rings, and a mesh of the plane has two for each vertex at most.
  const std::size_t triangles = std::min(ring_entries, 2 * vertices);
  return vertices * (sizeof(VertexRecord<T>) + 2 * sizeof(PointRecord<T>)) +
         triangles * (sizeof(TriangleRecord<T>) + sizeof(Corners)) + ring_entries * index_bytes;
}

template <class T>
std::size_t engine_bytes(std::size_t vertices, std::size_t free_vertices, std::size_t ring_entries,
                         const SmoothingOptions& options) {
  if (options.execution != Execution::resident) {
    return paper_mesh_bytes<T>(vertices, ring_entries);
  }
  const std::size_t buffers = options.form == Form::swap ? 2 : 1;
  return buffers * (vertices * sizeof(PointRecord<T>) + free_vertices / 8);
}

/// The rings in packed numbering. Patches of small meshes take more, which matters to no device.
std::size_t packed_ring_bytes(std::size_t free_vertices, std::size_t ring_entries, const SmoothingOptions& options) {
  if (options.execution != Execution::resident) {
    return (free_vertices + ring_entries) * index_bytes;
  }
  const std::size_t record =
      options.form == Form::swap ? sizeof(RingRecord<std::int16_t>) : sizeof(RingRecord<std::int32_t>);
  // One ring in ten, or less, is too long for a record.
  return free_vertices * record + ring_entries / 8 * index_bytes;
}

}  // namespace

std::size_t memory_need(const MeshSize& size, const SmoothingOptions& options) {
  const auto vertices = static_cast<std::size_t>(size.vertices);
  const auto free_vertices = static_cast<std::size_t>(size.free_vertices);
  const auto ring_entries = static_cast<std::size_t>(size.ring_entries);
  const std::size_t rings = vertices * index_bytes + ring_entries * index_bytes;
  const std::size_t packed = packed_ring_bytes(free_vertices, ring_entries, options);
  const std::size_t sorting = vertices * (2 * sizeof(std::uint64_t) + 4 * index_bytes);
  const std::size_t packing = rings + std::max(sorting, 3 * vertices * index_bytes + packed);
  const std::size_t engine = options.precision == Precision::double_precision
                                 ? engine_bytes<double>(vertices, free_vertices, ring_entries, options)
                                 : engine_bytes<float>(vertices, free_vertices, ring_entries, options);
  const std::size_t guard = free_vertices;
  const std::size_t smoothing = vertices * (point_bytes + index_bytes) + packed + engine + guard;
  return std::max(packing, smoothing);
}

std::size_t topology_memory_need(std::int64_t vertices, std::int64_t triangles) {
  // A vertex: where its corners begin, its flags, and while the mesh is oriented its local coordinates. A triangle:
  // three corners, its component, its orientation.
  return static_cast<std::size_t>(vertices) * (index_bytes + 1 + point_bytes) +
         static_cast<std::size_t>(triangles) * (4 * index_bytes + 1);
}

void require_memory(std::size_t bytes) {
  if (bytes <= kept_memory()) {
    return;  // asking the system takes its time
  }
  if (const DeviceMemory memory = device_memory(); bytes > memory.free) {
    throw too_little_memory("about " + mebibytes(bytes), memory);
  }
}

}  // namespace trismooth::cuda

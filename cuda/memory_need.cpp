// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/memory_need.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_memory.h"
#include "trismooth/cuda/sweep_engine.h"

namespace trismooth::cuda {

namespace {

constexpr std::size_t point_bytes = sizeof(Point2<double>);
constexpr std::size_t index_bytes = sizeof(std::int32_t);

}  // namespace

std::size_t memory_need(const MeshSize& size, const SmoothingOptions& options) {
  const auto vertices = static_cast<std::size_t>(size.vertices);
  const auto free_vertices = static_cast<std::size_t>(size.free_vertices);
  const auto ring_entries = static_cast<std::size_t>(size.ring_entries);
  const std::size_t rings = (vertices + (size.has_quadrilaterals ? 2 : 1) * ring_entries) * index_bytes;
  // Patches of small meshes take more than what they stand in for, which matters to no device.
  const auto [packed, engine] =
      with_rings_kind(options, size.has_quadrilaterals, [&]<class Rings>(std::type_identity<Rings>) {
        return std::pair(Rings::bytes(size), options.precision == Precision::double_precision
                                                 ? EngineOver<double, Rings>::bytes(size)
                                                 : EngineOver<float, Rings>::bytes(size));
      });
  const std::size_t sorting = vertices * (2 * sizeof(std::uint64_t) + 4 * index_bytes);
  const std::size_t packing = rings + std::max(sorting, 3 * vertices * index_bytes + packed);
  const std::size_t guard = free_vertices;
  const std::size_t targets = options.precision == Precision::double_precision
                                  ? DeviceTargets<double>::bytes(size.vertices, size.free_vertices, options)
                                  : DeviceTargets<float>::bytes(size.vertices, size.free_vertices, options);
  const std::size_t smoothing = vertices * (point_bytes + index_bytes) + packed + engine + targets + guard;
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

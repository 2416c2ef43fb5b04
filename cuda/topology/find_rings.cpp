// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/topology/find_rings.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/device_topology.h"
#include "trismooth/cuda/topology/uploaded_constraints.h"

namespace trismooth::cuda {

namespace {

/// Throws what the host would throw first: a fault of the triangles comes before one of the constraints.
void check_lengths(std::int32_t vertex_count, std::span<const Triangle> triangles, const Constraints& constraints) {
  try {
    check_constraints(constraints, vertex_count, std::ssize(triangles));
  } catch (const std::invalid_argument&) {
    Workers workers(0);
    connect_triangles(vertex_count, triangles, workers);
    throw;
  }
}

OneRings copied_to_host(Context& context, const DeviceRings& rings) {
  const std::vector<std::uint32_t> offsets =
      download(context, rings.offsets.data(), static_cast<std::size_t>(rings.size()) + 1);
  OneRings copy;
  copy.offsets.assign(offsets.begin(), offsets.end());
  copy.neighbours.resize(rings.neighbours.size());
  rings.neighbours.download(copy.neighbours);
  return copy;
}

}  // namespace

MeshRings find_rings_on_device(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                               const Constraints& constraints, NeighbourSearch way, Layers layers) {
  check_mesh_size(std::ssize(points), std::ssize(triangles));
  const auto vertex_count = static_cast<std::int32_t>(points.size());
  check_lengths(vertex_count, triangles, constraints);

  Context context;
  const DeviceBuffer<Triangle> device_triangles(context, triangles);
  const DeviceBuffer<Point2<double>> device_points(context, points);
  const UploadedConstraints uploaded(context, constraints);
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
  DeviceTopology topology(context, vertex_count, static_cast<std::int32_t>(triangles.size()),
                          reinterpret_cast<const std::int32_t*>(device_triangles.data()), uploaded.view(), way);
  topology.orient(device_points.data());

  MeshRings found;
  std::vector<std::int32_t> held;
  found.layers = topology.hold_layers(device_points.data(), layers, constraints.slide.along != Slide::off, held);
  found.rings = copied_to_host(context, topology.rings());
  found.fixed = download(context, topology.fixed(), points.size());
  found.reversed = download(context, topology.reversed(), triangles.size());
  found.components = topology.components();
  found.reoriented_triangles = topology.reoriented_triangles();
  return found;
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/topology/device_topology.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/primitives/gather_bytes.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/topology/flat_triangles.h"
#include "trismooth/cuda/topology/near_lines.h"
#include "trismooth/cuda/topology/ring_building.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth::cuda {

namespace {

/// Throws what the host says of what the device has refused: every message has one definition, and a fault of the
/// triangles comes before one of the constraints.
void throw_host_error(const Context& context, std::int32_t vertex_count, const TriangleList& triangles,
                      const DeviceConstraints& constraints) {
  Workers workers(0);
  const auto* const listed = reinterpret_cast<const Triangle*>(triangles.vertices);
  connect_triangles(vertex_count, download(context, listed, static_cast<std::size_t>(triangles.count)), workers);
  const auto fixed_ids = download(context, constraints.fixed_ids, static_cast<std::size_t>(constraints.fixed_id_count));
  check_constraints({.fixed_ids = fixed_ids}, vertex_count, triangles.count);
  throw DeviceError("CUDA: the device has refused a mesh in which the host finds no fault");
}

}  // namespace

DeviceTopology::DeviceTopology(Context& context, std::int32_t vertex_count, std::int32_t triangle_count,
                               const std::int32_t* triangles, const DeviceConstraints& constraints, NeighbourSearch way)
    : ListTopology(context, {triangles, triangle_count}) {
  check_mesh_size(vertex_count, triangle_count);
  DeviceBuffer<Findings> device_findings(context, 1);
  device_findings.fill_bytes(0);
  const auto found = [&] {
    const Findings findings = download(context, device_findings.data());
    if (findings.faults != 0) {
      throw_host_error(context, vertex_count, list_, constraints);
    }
    return findings;
  };
  // What is wrong with triangles is asked for later: they are left out, and each question costs a wait.
  corners_ = find_neighbours(context, vertex_count, list_, way, device_findings.data());
  fixed_ = DeviceBuffer<std::uint8_t>(context, static_cast<std::size_t>(vertex_count));
  DeviceBuffer<std::uint32_t> forest_words(context, static_cast<std::size_t>(triangle_count));
  const ParityForest forest{forest_words.data()};
  determine_constraints(context, list_, corners_.view(), constraints, forest, fixed_.data(), device_findings.data());
  const Findings neighbourhoods = found();
  if (neighbourhoods.large_vertices > 0) {
    large_fans_ = find_large_fans(context, list_, corners_.view(), neighbourhoods, constraints.regions, forest,
                                  fixed_.data(), device_findings.data());
    found();
  }
  components_ = number_components(context, std::move(forest_words));
}

NearLines DeviceTopology::near_lines(const std::int32_t* regions) {
  return cuda::near_lines(*context_, list_, vertex_count(), fixed_.data(), regions);
}

LayersResult DeviceTopology::hold_layers(const Point2<double>* local_points, Layers layers, bool slides,
                                         std::vector<std::int32_t>& held) {
  held.clear();
  if (layers == Layers::smooth) {
    return {};
  }
  const LayerCandidates candidates(*context_, list_, vertex_count(), local_points, reversed());
  Workers workers(0);
  LayerSearch found =
      search_layers([&](int choices) { return candidates.after(choices); }, vertex_count(), layers, workers);
  if (!found.kept.empty()) {
    const std::vector<std::uint8_t> reasons = hold_of_layers(*context_, found.kept, slides, fixed_.data());
    for (std::size_t i = 0; i < reasons.size(); ++i) {
      if (count_in_layer(reasons[i], slides, found.result)) {
        held.push_back(found.kept[i]);
      }
    }
  }
  if (!found.left.empty()) {
    const DeviceBuffer<std::int32_t> left(*context_, found.left);
    found.result.left = std::ranges::count(gather_bytes(*context_, fixed_.data(), left), 0);
  }
  return found.result;
}

DeviceRings DeviceTopology::rings() {
  return build_rings(*context_, list_, corners_.view(), large_fans_, fixed(), reversed());
}

OwnElements DeviceTopology::elements() const {
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t));
  return download(*context_, reinterpret_cast<const Triangle*>(list_.vertices), element_count());
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/layers/layers.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/listed_rings.h"

namespace trismooth {

namespace {

constexpr std::int64_t rings_grain = 16384;

using OpenMesh::EdgeHandle;
using OpenMesh::HalfedgeHandle;

/// Marks the ends of edges between two regions.
void hold_interfaces(const HalfedgeMesh& halfedges, std::span<const std::int32_t> regions,
                     std::span<std::uint8_t> reasons, Workers& workers) {
  const ElementMesh& mesh = halfedges.mesh;
  const auto hold_end = [&](HalfedgeHandle h) {
    const auto v = static_cast<std::size_t>(mesh.to_vertex_handle(h).idx());
    set_bits_relaxed(
        reasons[v < reasons.size() ? v : static_cast<std::size_t>(halfedges.copies_of[v - reasons.size()])],
        hold::interface);
  };
  workers.for_blocks(static_cast<std::int64_t>(mesh.n_edges()), rings_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto e = static_cast<int>(begin); e < end; ++e) {
      const HalfedgeHandle one = mesh.halfedge_handle(EdgeHandle(e), 0);
      const HalfedgeHandle other = mesh.halfedge_handle(EdgeHandle(e), 1);
      if (!mesh.is_boundary(one) && !mesh.is_boundary(other) &&
          regions[static_cast<std::size_t>(mesh.face_handle(one).idx())] !=
              regions[static_cast<std::size_t>(mesh.face_handle(other).idx())]) {
        hold_end(one);
        hold_end(other);
      }
    }
  });
}

/// In the way that is quickest for them.
TriangleTopology topology_of(std::int32_t vertices, const ElementList& elements, Workers& workers) {
  if (elements.are_triangles()) {
    if (auto listed = find_listed_topology(vertices, elements.triangles(), workers)) {
      return *std::move(listed);
    }
  }
  return elements.visit([&](const auto& listed) { return connect_triangles(vertices, listed, workers); });
}

}  // namespace

ConnectedMesh connect_halfedges(std::span<const double> xyz, const ElementList& elements, Workers& workers) {
  const auto vertex_count = std::ssize(xyz) / 3;
  check_mesh_size(vertex_count, static_cast<std::int64_t>(elements.size()), elements.are_triangles() ? 3 : 4);
  TriangleTopology topology = topology_of(static_cast<std::int32_t>(vertex_count), elements, workers);
  // (OpenMesh's meshes cannot be moved: this one is made where it stays.)
  return {build_halfedge_mesh(xyz, elements, topology, topology.parity, workers), std::move(topology)};
}

MeshRings read_halfedge_rings(const ConnectedMesh& connected, std::span<const Point2<double>> local,
                              const ElementList& elements, const Constraints& constraints, Workers& workers,
                              Layers layers) {
  const TriangleTopology& topology = connected.topology;
  check_constraints(constraints, topology.vertex_count, static_cast<std::int64_t>(elements.size()));
  Orientation orientation =
      elements.visit([&](const auto& listed) { return orient(topology, listed, local, workers); });
  MeshRings found;
  found.found_by = Topology::halfedge;
  found.fixed = topology.hold;
  hold_named_vertices(constraints, found.fixed);
  if (!constraints.regions.empty()) {
    hold_interfaces(connected.halfedges, constraints.regions, found.fixed, workers);
  }
  found.layers = elements.visit([&](const auto& listed) {
    return hold_layers(local, listed, orientation.reversed, layers, constraints.slide.along != Slide::off, found.fixed,
                       workers);
  });
  found.slidable = find_slidable(elements, found.fixed, constraints, workers);
  // A component that the halfedges run through clockwise is read the other way round.
  std::vector<std::uint8_t> clockwise(elements.size());
  workers.for_blocks(std::ssize(clockwise), rings_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      clockwise[t] = orientation.reversed[t] ^ topology.parity[t];
    }
  });
  found.rings = one_rings(connected.halfedges, topology.degree, found.fixed, clockwise, workers);
  found.reversed = std::move(orientation.reversed);
  found.components = topology.components;
  found.reoriented_triangles = orientation.reoriented_triangles;
  return found;
}

}  // namespace trismooth

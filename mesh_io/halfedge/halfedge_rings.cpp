#include "trismooth/mesh_io/halfedge/halfedge_rings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/relaxed_atomics.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/layers/layers.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"

namespace trismooth {

namespace {

constexpr std::int64_t rings_grain = 16384;

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;

/// A halfedge mesh, and what is known of it beside its halfedges.
struct Halfedges {
  const TriangleMesh& mesh;
  std::span<const std::int32_t> copies_of;  ///< as HalfedgeMesh::copies_of
  std::vector<std::uint8_t> hold;           ///< likewise
  const TriangleComponents& components;     ///< the parity says which faces run against their triangle
};

/// Marks the ends of edges between two regions.
void hold_interfaces(const Halfedges& halfedges, std::span<const std::int32_t> regions, std::span<std::uint8_t> reasons,
                     Workers& workers) {
  const TriangleMesh& mesh = halfedges.mesh;
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

MeshRings read_rings(const Halfedges& halfedges, std::span<const Point2<double>> local,
                     std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                     Layers layers) {
  Orientation orientation = orient(halfedges.components, triangles, local, workers);
  MeshRings found;
  found.fixed = halfedges.hold;
  hold_named_vertices(constraints, found.fixed);
  if (!constraints.regions.empty()) {
    hold_interfaces(halfedges, constraints.regions, found.fixed, workers);
  }
  found.layers = hold_layers(local, triangles, orientation.reversed, layers, constraints.slide.along != Slide::off,
                             found.fixed, workers);
  found.slidable = find_slidable(triangles, found.fixed, constraints, workers);
  // A component that the halfedges run through clockwise is read the other way round.
  std::vector<std::uint8_t> clockwise(triangles.size());
  workers.for_blocks(std::ssize(clockwise), rings_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      clockwise[t] = orientation.reversed[t] ^ halfedges.components.parity[t];
    }
  });
  found.rings = one_rings(halfedges.mesh, found.fixed, clockwise, workers, halfedges.copies_of);
  found.reversed = std::move(orientation.reversed);
  found.components = halfedges.components.components;
  found.reoriented_triangles = orientation.reoriented_triangles;
  return found;
}

/// The faces of a halfedge mesh run alike within each component.
TriangleComponents components_of(const TriangleMesh& mesh) {
  TriangleComponents found;
  found.parity.assign(mesh.n_faces(), 0);
  found.component.assign(mesh.n_faces(), -1);
  std::vector<FaceHandle> reached;
  for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
    if (found.component[static_cast<std::size_t>(f)] >= 0) {
      continue;
    }
    found.component[static_cast<std::size_t>(f)] = found.components;
    reached.emplace_back(f);
    while (!reached.empty()) {
      HalfedgeHandle h = mesh.halfedge_handle(reached.back());
      reached.pop_back();
      for (int side = 0; side < 3; ++side) {
        const FaceHandle neighbour = mesh.face_handle(mesh.opposite_halfedge_handle(h));
        if (neighbour.is_valid() && found.component[static_cast<std::size_t>(neighbour.idx())] < 0) {
          found.component[static_cast<std::size_t>(neighbour.idx())] = found.components;
          reached.push_back(neighbour);
        }
        h = mesh.next_halfedge_handle(h);
      }
    }
    ++found.components;
  }
  return found;
}

/// What a halfedge mesh itself holds.
std::vector<std::uint8_t> held_by(const TriangleMesh& mesh, Workers& workers) {
  std::vector<std::uint8_t> held(mesh.n_vertices(), 0);
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    if (mesh.is_boundary(HalfedgeHandle(h))) {
      held[static_cast<std::size_t>(mesh.from_vertex_handle(HalfedgeHandle(h)).idx())] |= hold::boundary;
      held[static_cast<std::size_t>(mesh.to_vertex_handle(HalfedgeHandle(h)).idx())] |= hold::boundary;
    }
  }
  mark_fans(mesh, held, workers);
  return held;
}

}  // namespace

MeshRings find_halfedge_rings(std::span<const double> xyz, std::span<const Point2<double>> local,
                              std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                              Layers layers) {
  check_mesh_size(std::ssize(local), std::ssize(triangles));
  MatchedSides sides = match_sides(static_cast<std::int32_t>(local.size()), triangles, workers);
  check_constraints(constraints, sides.vertex_count, std::ssize(triangles));
  HalfedgeMesh built = build_halfedge_mesh(xyz, triangles, sides, sides.parity, workers);
  sides.twins = BulkVector<std::int32_t>();  // its memory is free for the rings
  return read_rings({built.mesh, built.copies_of, std::move(built.hold), sides}, local, triangles, constraints, workers,
                    layers);
}

MeshRings read_halfedge_rings(const TriangleMesh& mesh, std::span<const Point2<double>> local,
                              std::span<const Triangle> triangles, const Constraints& constraints, Workers& workers,
                              Layers layers) {
  check_mesh_size(std::ssize(local), std::ssize(triangles));
  check_triangles(static_cast<std::int32_t>(local.size()), triangles);
  check_constraints(constraints, static_cast<std::int32_t>(local.size()), std::ssize(triangles));
  const TriangleComponents components = components_of(mesh);
  return read_rings({mesh, {}, held_by(mesh, workers), components}, local, triangles, constraints, workers, layers);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/flat_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

/// Faces that a thread takes at a time.
constexpr std::int64_t faces_grain = 16384;

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::PolyConnectivity;
using OpenMesh::VertexHandle;

bool is_deleted(const PolyConnectivity& mesh, VertexHandle v) {
  return mesh.has_vertex_status() && mesh.status(v).deleted();
}

bool is_deleted(const PolyConnectivity& mesh, EdgeHandle e) {
  return mesh.has_edge_status() && mesh.status(e).deleted();
}

bool is_deleted(const PolyConnectivity& mesh, FaceHandle f) {
  return mesh.has_face_status() && mesh.status(f).deleted();
}

Triangle corners_of(const PolyConnectivity& mesh, FaceHandle f) {
  Triangle triangle{};
  const HalfedgeHandle first = mesh.halfedge_handle(f);
  HalfedgeHandle h = first;
  for (std::int32_t& corner : triangle) {
    corner = mesh.from_vertex_handle(h).idx();
    h = mesh.next_halfedge_handle(h);
  }
  if (h != first) {
    throw std::invalid_argument("face " + std::to_string(f.idx()) + " has " + std::to_string(mesh.valence(f)) +
                                " corners, and only triangles are taken; mesh.triangulate() cuts it");
  }
  return triangle;
}

/// The marks of what a mesh says by its status.
class Marks {
 public:
  explicit Marks(const PolyConnectivity& mesh) : mesh_(mesh), flags_(mesh.n_vertices(), 0) {}

  void add(VertexHandle v) { flags_[static_cast<std::size_t>(v.idx())] = 1; }
  void add_ends(HalfedgeHandle h) {
    add(mesh_.from_vertex_handle(h));
    add(mesh_.to_vertex_handle(h));
  }
  std::vector<std::uint8_t> take() && { return std::move(flags_); }

 private:
  const PolyConnectivity& mesh_;
  std::vector<std::uint8_t> flags_;
};

bool holds(const OpenMesh::Attributes::StatusInfo& status) {
  return status.locked() || status.feature();
}

/// Marks what is locked or a feature.
void mark_held(const PolyConnectivity& mesh, const FlatMesh& flat, Marks& marks) {
  if (mesh.has_vertex_status()) {
    for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
      // A deleted vertex that a face still has stays as well.
      if (const auto& status = mesh.status(VertexHandle(v)); holds(status) || status.deleted()) {
        marks.add(VertexHandle(v));
      }
    }
  }
  if (mesh.has_edge_status() || mesh.has_halfedge_status()) {
    for (int e = 0; e < static_cast<int>(mesh.n_edges()); ++e) {
      const HalfedgeHandle one = mesh.halfedge_handle(EdgeHandle(e), 0);
      const HalfedgeHandle other = mesh.halfedge_handle(EdgeHandle(e), 1);
      const bool is_held = (mesh.has_edge_status() && holds(mesh.status(EdgeHandle(e)))) ||
                           (mesh.has_halfedge_status() && (holds(mesh.status(one)) || holds(mesh.status(other))));
      if (is_held && !is_deleted(mesh, EdgeHandle(e))) {
        marks.add_ends(one);
      }
    }
  }
  if (mesh.has_face_status()) {
    for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
      if (mesh.status(FaceHandle(flat.faces[t])).locked()) {
        for (const std::int32_t corner : flat.triangles[t]) {
          marks.add(VertexHandle(corner));
        }
      }
    }
  }
}

/// Marks the vertices whose number is not 0.
void mark_numbered(const PolyConnectivity& mesh, const VertexNumbers& numbers, const char* member, Marks& marks) {
  if (numbers.empty()) {
    return;
  }
  const auto number = numbers.of(mesh, member);
  for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
    if (!is_deleted(mesh, VertexHandle(v)) && number(VertexHandle(v)) != 0) {
      marks.add(VertexHandle(v));
    }
  }
}

std::vector<std::int32_t> regions_of(const PolyConnectivity& mesh, const FlatMesh& flat, const FaceNumbers& numbers) {
  if (numbers.empty()) {
    return {};
  }
  const auto number = numbers.of(mesh, "MeshConstraints::regions");
  std::vector<std::int64_t> regions(flat.triangles.size());
  for (std::size_t t = 0; t < regions.size(); ++t) {
    regions[t] = number(FaceHandle(flat.faces[t]));
  }
  using Limits = std::numeric_limits<std::int32_t>;
  if (std::ranges::all_of(regions, [](std::int64_t r) { return Limits::min() <= r && r <= Limits::max(); })) {
    return {regions.begin(), regions.end()};
  }
  // Those beyond 32 bits are told apart by their places in their order.
  std::vector<std::int64_t> sorted = regions;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<std::int32_t> places(regions.size());
  std::ranges::transform(regions, places.begin(), [&](std::int64_t r) {
    return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), r) - sorted.begin());
  });
  return places;
}

}  // namespace

FlatMesh flat_mesh(const PolyConnectivity& mesh) {
  FlatMesh flat{.vertices = static_cast<std::int64_t>(mesh.n_vertices()),
                .all_faces = static_cast<std::int64_t>(mesh.n_faces()),
                .triangles = {},
                .faces = {},
                .in_a_cell = std::vector<std::uint8_t>(mesh.n_vertices(), 0)};
  flat.triangles.reserve(mesh.n_faces());
  flat.faces.reserve(mesh.n_faces());
  for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
    if (is_deleted(mesh, FaceHandle(f))) {
      continue;
    }
    flat.faces.push_back(f);
    flat.triangles.push_back(corners_of(mesh, FaceHandle(f)));
    for (const std::int32_t corner : flat.triangles.back()) {
      flat.in_a_cell[static_cast<std::size_t>(corner)] = 1;
    }
  }
  return flat;
}

bool has_faces_of(const PolyConnectivity& mesh, const FlatMesh& flat, Workers& workers) {
  std::atomic<bool> differs{false};
  std::atomic<std::int64_t> deleted{0};
  workers.for_blocks(flat.all_faces, faces_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t deleted_here = 0;
    for (auto f = static_cast<int>(begin); f < end; ++f) {
      deleted_here += is_deleted(mesh, FaceHandle(f)) ? 1 : 0;
    }
    deleted.fetch_add(deleted_here, std::memory_order_relaxed);
  });
  workers.for_blocks(std::ssize(flat.triangles), faces_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end && !differs; ++t) {
      const FaceHandle f(flat.faces[t]);
      HalfedgeHandle h = mesh.halfedge_handle(f);
      const bool is_same = !is_deleted(mesh, f) && std::ranges::all_of(flat.triangles[t], [&](std::int32_t corner) {
        const bool is_corner = mesh.from_vertex_handle(h).idx() == corner;
        h = mesh.next_halfedge_handle(h);
        return is_corner;
      });
      if (!is_same) {
        differs = true;
      }
    }
  });
  return !differs && deleted == flat.all_faces - std::ssize(flat.triangles);
}

KeptConstraints flat_constraints(const PolyConnectivity& mesh, const FlatMesh& flat,
                                 const MeshConstraints& constraints) {
  Marks fixed(mesh);
  mark_held(mesh, flat, fixed);
  mark_numbered(mesh, constraints.fixed, "MeshConstraints::fixed", fixed);
  Marks other_cells(mesh);
  mark_numbered(mesh, constraints.other_cells, "MeshConstraints::other_cells", other_cells);
  const std::vector<std::uint8_t> fixed_flags = std::move(fixed).take();
  const std::vector<std::uint8_t> other_flags = std::move(other_cells).take();
  const std::vector<std::int32_t> regions = regions_of(mesh, flat, constraints.regions);
  return KeptConstraints({.fixed = fixed_flags,
                          .fixed_ids = constraints.fixed_ids,
                          .other_cells = other_flags,
                          .regions = regions,
                          .slide = constraints.slide});
}

}  // namespace trismooth

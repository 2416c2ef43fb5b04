// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/flat_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/element.h"

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

/// Calls visit(corner) for the corners of a face, in turn, always from the same one on.
template <class Visit>
void for_corners(const PolyConnectivity& mesh, FaceHandle f, const Visit& visit) {
  const HalfedgeHandle first = mesh.halfedge_handle(f);
  HalfedgeHandle h = first;
  do {
    visit(mesh.to_vertex_handle(h).idx());
    h = mesh.next_halfedge_handle(h);
  } while (h != first);
}

/// The corners of a face of three or four sides; nothing where it has more.
std::optional<MixedElement> element_of(const PolyConnectivity& mesh, FaceHandle f) {
  MixedElement corners{no_corner, no_corner, no_corner, no_corner};
  std::size_t count = 0;
  for_corners(mesh, f, [&](std::int32_t corner) {
    if (count < corners.size()) {
      corners[count] = corner;
    }
    ++count;
  });
  if (count < 3) {
    throw std::invalid_argument("face " + std::to_string(f.idx()) + " has " + std::to_string(count) +
                                " corners, expected three or more");
  }
  return count <= corners.size() ? std::optional(corners) : std::nullopt;
}

void append_polygon(const PolyConnectivity& mesh, FaceHandle f, FlatMesh& flat) {
  std::vector<std::int32_t> corners;
  for_corners(mesh, f, [&](std::int32_t corner) { corners.push_back(corner); });
  flat.polygons.append(cell_type::polygon, corners);
  flat.polygon_faces.push_back(f.idx());
}

/// Whether the face is not deleted and these are the corners that for_corners() visits.
bool is_face_of(const PolyConnectivity& mesh, FaceHandle f, std::span<const std::int32_t> corners) {
  if (is_deleted(mesh, f)) {
    return false;
  }
  std::size_t same = 0;
  std::size_t count = 0;
  for_corners(mesh, f, [&](std::int32_t corner) {
    same += count < corners.size() && corners[count] == corner ? 1 : 0;
    ++count;
  });
  return count == corners.size() && same == count;
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
void mark_held(const PolyConnectivity& mesh, Marks& marks) {
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
    for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
      if (const auto& status = mesh.status(FaceHandle(f)); status.locked() && !status.deleted()) {
        for_corners(mesh, FaceHandle(f), [&](std::int32_t corner) { marks.add(VertexHandle(corner)); });
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
  std::vector<std::int64_t> regions(flat.faces.size());
  std::ranges::transform(flat.faces, regions.begin(), [&](std::int32_t f) { return number(FaceHandle(f)); });
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
                .elements = {},
                .faces = {},
                .polygons = {},
                .polygon_faces = {},
                .in_a_cell = std::vector<std::uint8_t>(mesh.n_vertices(), 0)};
  flat.elements.reserve(mesh.n_faces());
  flat.faces.reserve(mesh.n_faces());
  for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
    if (is_deleted(mesh, FaceHandle(f))) {
      continue;
    }
    if (const auto element = element_of(mesh, FaceHandle(f))) {
      flat.faces.push_back(f);
      flat.elements.append(*element);
      for (const std::int32_t corner : corners_of(*element)) {
        flat.in_a_cell[static_cast<std::size_t>(corner)] = 1;
      }
    } else {
      append_polygon(mesh, FaceHandle(f), flat);
    }
  }
  for (const std::int32_t corner : flat.polygons.connectivity) {
    flat.in_a_cell[static_cast<std::size_t>(corner)] = 1;
  }
  return flat;
}

CellList cells_of(const FlatMesh& mesh) {
  CellList cells = mesh.polygons;
  mesh.elements.list().visit([&](const auto& listed) {
    for (const auto& element : listed) {
      const std::span<const std::int32_t> corners = corners_of(element);
      cells.append(cell_type::of_face(corners.size()), corners);
    }
  });
  return cells;
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
  const auto compare = [&](const std::vector<std::int32_t>& faces, const auto& corners) {
    workers.for_blocks(std::ssize(faces), faces_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end) && !differs; ++i) {
        if (!is_face_of(mesh, FaceHandle(faces[i]), corners[i])) {
          differs = true;
        }
      }
    });
  };
  compare(flat.faces, flat.elements.list());
  compare(flat.polygon_faces, flat.polygons);
  return !differs && deleted == flat.all_faces - std::ssize(flat.faces) - std::ssize(flat.polygon_faces);
}

KeptConstraints flat_constraints(const PolyConnectivity& mesh, const FlatMesh& flat,
                                 const MeshConstraints& constraints) {
  Marks fixed(mesh);
  mark_held(mesh, fixed);
  mark_numbered(mesh, constraints.fixed, "MeshConstraints::fixed", fixed);
  Marks other_cells(mesh);
  mark_numbered(mesh, constraints.other_cells, "MeshConstraints::other_cells", other_cells);
  for (const std::int32_t corner : flat.polygons.connectivity) {
    other_cells.add(VertexHandle(corner));
  }
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

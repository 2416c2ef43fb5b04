#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_set>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

constexpr std::int64_t grain = 16384;

/// Calls visit(halfedge) for each halfedge of a face that leaves the vertex of `first`, which is one of them, as far as
/// faces follow each other around it. Asks nothing of the halfedges outside.
template <class Visit>
void for_each_of_fan(const TriangleMesh& mesh, HalfedgeHandle first, Visit visit) {
  HalfedgeHandle leaving = first;
  do {
    visit(leaving);
    leaving = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(leaving));
  } while (leaving != first && !mesh.is_boundary(leaving));
  if (leaving != first) {
    // An open fan: to its other end as well.
    HalfedgeHandle arriving = mesh.opposite_halfedge_handle(first);
    while (!mesh.is_boundary(arriving)) {
      leaving = mesh.next_halfedge_handle(arriving);
      visit(leaving);
      arriving = mesh.opposite_halfedge_handle(leaving);
    }
  }
}

class Builder {
 public:
  Builder(std::span<const Triangle> triangles, const MatchedSides& sides, std::span<const std::uint8_t> reversed,
          HalfedgeMesh& result)
      : triangles_(triangles), sides_(sides), reversed_(reversed), result_(result), mesh_(result.mesh) {}

  void build(std::span<const double> xyz, Workers& workers) {
    check_halfedge_mesh_size(sides_.vertex_count, std::ssize(triangles_),
                             std::ranges::count_if(sides_.twins, [](std::int32_t twin) { return twin < 0; }));
    number_edges();
    const auto vertices = static_cast<std::size_t>(sides_.vertex_count);
    mesh_.resize(vertices, edge_count_, triangles_.size());
    for (std::size_t v = 0; v < vertices; ++v) {
      mesh_.set_point(VertexHandle(static_cast<int>(v)), {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
    }
    fill_faces();
    result_.hold = sides_.hold;
    mark_fans(mesh_, result_.hold, workers);
    if (std::ranges::any_of(result_.hold, [](std::uint8_t reasons) { return (reasons & hold::bow_tie) != 0; })) {
      split_fans();
    }
    close_boundaries();
  }

 private:
  /// Numbers the edges in the order in which triangles first meet them.
  void number_edges() {
    halfedges_.resize(sides_.twins.size());
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(halfedges_.size()); ++h) {
      const std::int32_t twin = sides_.twins[h];
      halfedges_[h] = twin >= 0 && twin < h ? halfedges_[twin] + 1 : 2 * static_cast<std::int32_t>(edge_count_++);
    }
  }

  void fill_faces() {
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles_.size()); ++t) {
      const bool reversed = reversed_[t] != 0;
      const FaceHandle face(t);
      for (std::int32_t i = 0; i < 3; ++i) {
        const HalfedgeHandle inner(halfedges_[3 * t + i]);
        const VertexHandle from(triangles_[t][reversed ? (i + 1) % 3 : i]);
        const VertexHandle to(triangles_[t][reversed ? i : (i + 1) % 3]);
        mesh_.set_vertex_handle(inner, to);
        mesh_.set_face_handle(inner, face);
        mesh_.set_next_halfedge_handle(inner, HalfedgeHandle(halfedges_[3 * t + (i + (reversed ? 2 : 1)) % 3]));
        mesh_.set_halfedge_handle(from, inner);
        if (sides_.twins[3 * t + i] < 0) {
          const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(inner);
          mesh_.set_vertex_handle(outer, from);
          mesh_.set_boundary(outer);
        }
      }
      mesh_.set_halfedge_handle(face, HalfedgeHandle(halfedges_[3 * static_cast<std::size_t>(t)]));
    }
  }

  /// Gives every fan of a vertex but the first a vertex of its own.
  void split_fans() {
    std::unordered_set<std::int32_t> begun;  // vertices whose first fan is done
    std::unordered_set<int> done;            // halfedges that leave such a vertex
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(3 * triangles_.size()); ++corner) {
      const std::int32_t t = corner / 3;
      const std::int32_t v = triangles_[t][corner % 3];
      const HalfedgeHandle leaving(halfedges_[reversed_[t] != 0 ? 3 * t + (corner + 2) % 3 : corner]);
      if ((result_.hold[v] & hold::bow_tie) == 0 || done.contains(leaving.idx())) {
        continue;
      }
      const VertexHandle vertex = begun.insert(v).second ? VertexHandle(v) : copy_of(v);
      for_each_of_fan(mesh_, leaving, [&](HalfedgeHandle h) {
        done.insert(h.idx());
        mesh_.set_vertex_handle(mesh_.prev_halfedge_handle(h), vertex);
        if (mesh_.is_boundary(mesh_.opposite_halfedge_handle(h))) {
          mesh_.set_vertex_handle(mesh_.opposite_halfedge_handle(h), vertex);
        }
      });
      mesh_.set_halfedge_handle(vertex, leaving);
    }
  }

  VertexHandle copy_of(std::int32_t v) {
    check_halfedge_mesh_size(static_cast<std::int64_t>(mesh_.n_vertices()) + 1, 0, 0);
    result_.copies_of.push_back(v);
    const Eigen::Vector3d point = mesh_.point(VertexHandle(v));
    return mesh_.add_vertex(point);
  }

  /// Links the outer halfedges around each fan's gap; they are the outgoing ones of their vertices, as OpenMesh wants.
  void close_boundaries() {
    for (std::size_t h = 0; h < halfedges_.size(); ++h) {
      if (sides_.twins[h] < 0) {
        const HalfedgeHandle inner(halfedges_[h]);
        const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(inner);
        HalfedgeHandle leaving = inner;
        while (!mesh_.is_boundary(leaving)) {
          leaving = mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(leaving));
        }
        mesh_.set_next_halfedge_handle(outer, leaving);
        mesh_.set_halfedge_handle(mesh_.from_vertex_handle(outer), outer);
      }
    }
  }

  std::span<const Triangle> triangles_;
  const MatchedSides& sides_;
  std::span<const std::uint8_t> reversed_;
  HalfedgeMesh& result_;
  TriangleMesh& mesh_;
  std::vector<std::int32_t> halfedges_;  ///< the mesh's halfedge of each triangle halfedge
  std::size_t edge_count_ = 0;
};

}  // namespace

void check_halfedge_mesh_size(std::int64_t vertices, std::int64_t triangles, std::int64_t unpaired_sides) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (vertices > most) {
    throw MeshError("more than " + std::to_string(most) +
                    " vertices in the halfedge mesh, where a vertex of several fans is one for each");
  }
  // Two halfedges an edge: each side of a triangle is one, and those that are not paired have another beside them.
  const std::int64_t halfedges = 3 * triangles + unpaired_sides;
  if (halfedges > most) {
    throw MeshError("more than " + std::to_string(most) + " halfedges: three for each of " + std::to_string(triangles) +
                    " triangles, and " + std::to_string(unpaired_sides) + " on the boundary");
  }
}

HalfedgeMesh build_halfedge_mesh(std::span<const double> xyz, std::span<const Triangle> triangles,
                                 const MatchedSides& sides, std::span<const std::uint8_t> reversed, Workers& workers) {
  HalfedgeMesh result;
  Builder(triangles, sides, reversed, result).build(xyz, workers);
  return result;
}

void mark_fans(const TriangleMesh& mesh, std::span<std::uint8_t> hold, Workers& workers) {
  std::vector<std::int32_t> faces(hold.size(), 0);
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    if (!mesh.is_boundary(HalfedgeHandle(h))) {
      ++faces[static_cast<std::size_t>(mesh.from_vertex_handle(HalfedgeHandle(h)).idx())];
    }
  }
  for (std::size_t v = 0; v < hold.size(); ++v) {
    hold[v] |= faces[v] == 0 ? hold::isolated : std::uint8_t{0};
  }
  // In the order of the halfedges, as in one_rings().
  workers.for_blocks(static_cast<std::int64_t>(mesh.n_halfedges()), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto h = static_cast<int>(begin); h < end; ++h) {
      const VertexHandle v = mesh.from_vertex_handle(HalfedgeHandle(h));
      if (mesh.halfedge_handle(v).idx() == h) {
        const HalfedgeHandle first = mesh.is_boundary(HalfedgeHandle(h))
                                         ? mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(HalfedgeHandle(h)))
                                         : HalfedgeHandle(h);
        std::int32_t size = 0;
        for_each_of_fan(mesh, first, [&](HalfedgeHandle) { ++size; });
        if (size != faces[static_cast<std::size_t>(v.idx())]) {
          hold[static_cast<std::size_t>(v.idx())] |= hold::bow_tie;
        }
      }
    }
  });
}

OneRings one_rings(const TriangleMesh& mesh, std::span<const std::uint8_t> fixed,
                   std::span<const std::uint8_t> reversed, Workers& workers, std::span<const std::int32_t> copies_of) {
  // In the order of the halfedges, which lie as the file lists its triangles: with more locality than its vertices.
  const auto for_free_vertices = [&](const auto& visit) {
    workers.for_blocks(static_cast<std::int64_t>(mesh.n_halfedges()), grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto h = static_cast<int>(begin); h < end; ++h) {
        const HalfedgeHandle first(h);
        const int v = mesh.from_vertex_handle(first).idx();
        if (static_cast<std::size_t>(v) < fixed.size() && fixed[v] == 0 &&
            mesh.halfedge_handle(VertexHandle(v)) == first) {
          visit(v, first);
        }
      }
    });
  };
  const auto rotated = [&](HalfedgeHandle h) { return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h)); };

  // A free vertex is an interior one: it has as many neighbours as outgoing halfedges.
  std::vector<std::int32_t> sizes(fixed.size(), 0);
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    const auto v = static_cast<std::size_t>(mesh.from_vertex_handle(HalfedgeHandle(h)).idx());
    if (v < fixed.size() && fixed[v] == 0) {
      ++sizes[v];
    }
  }
  OneRings rings =
      OneRings::with_sizes(static_cast<std::int32_t>(fixed.size()), [&](std::int32_t v) { return sizes[v]; });
  for_free_vertices([&](int v, HalfedgeHandle first) {
    const bool clockwise = !reversed.empty() && reversed[mesh.face_handle(first).idx()] != 0;
    rings.fill(v, [&, h = first]() mutable {
      const auto neighbour = static_cast<std::size_t>(mesh.to_vertex_handle(h).idx());
      h = clockwise ? mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(h)) : rotated(h);
      return neighbour < fixed.size() ? static_cast<std::int32_t>(neighbour) : copies_of[neighbour - fixed.size()];
    });
  });
  return rings;
}

}  // namespace trismooth

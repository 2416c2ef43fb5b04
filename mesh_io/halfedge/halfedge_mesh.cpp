#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

#include "trismooth/base/errors.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

class Builder {
 public:
  Builder(std::span<const Triangle> triangles, const TriangleTopology& topology, std::span<const std::uint8_t> reversed,
          HalfedgeMesh& result)
      : triangles_(triangles), topology_(topology), reversed_(reversed), result_(result), mesh_(result.mesh) {}

  void build(std::span<const double> xyz) {
    check_halfedge_mesh_size(topology_.vertex_count, std::ssize(triangles_),
                             std::ranges::count_if(topology_.twins, [](std::int32_t twin) { return twin < 0; }));
    split_fans();
    number_edges();
    const auto vertices = static_cast<std::size_t>(topology_.vertex_count) + result_.copies_of.size();
    mesh_.resize(vertices, edge_count_, triangles_.size());
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto input =
          v < topology_.hold.size() ? v : static_cast<std::size_t>(result_.copies_of[v - topology_.hold.size()]);
      mesh_.set_point(VertexHandle(static_cast<int>(v)), {xyz[3 * input], xyz[3 * input + 1], xyz[3 * input + 2]});
    }
    fill_faces();
    close_boundaries();
  }

 private:
  /// Gives every fan of a vertex but the first a vertex of its own.
  void split_fans() {
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(3 * triangles_.size()); ++corner) {
      const std::int32_t v = triangles_[corner / 3][corner % 3];
      if ((topology_.hold[v] & hold::bow_tie) != 0 && !fan_vertex_.contains(corner)) {
        std::int32_t vertex = v;
        if (topology_.corner[v] != corner) {
          check_halfedge_mesh_size(topology_.vertex_count + std::ssize(result_.copies_of) + 1, 0, 0);
          vertex = topology_.vertex_count + static_cast<std::int32_t>(result_.copies_of.size());
          result_.copies_of.push_back(v);
        }
        assign_fan(corner, vertex);
      }
    }
  }

  void assign_fan(std::int32_t first, std::int32_t vertex) {
    std::int32_t corner = first;
    do {
      fan_vertex_[corner] = vertex;
      corner = next_corner(topology_, triangles_, reversed_, corner);
    } while (corner >= 0 && corner != first);
    if (corner < 0) {
      corner = previous_corner(topology_, triangles_, reversed_, first);
      for (; corner >= 0; corner = previous_corner(topology_, triangles_, reversed_, corner)) {
        fan_vertex_[corner] = vertex;
      }
    }
  }

  VertexHandle vertex_at(std::int32_t corner) const {
    const std::int32_t v = triangles_[corner / 3][corner % 3];
    return VertexHandle((topology_.hold[v] & hold::bow_tie) != 0 ? fan_vertex_.at(corner) : v);
  }

  /// Numbers the edges in the order in which triangles first meet them.
  void number_edges() {
    halfedges_.resize(topology_.twins.size());
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(halfedges_.size()); ++h) {
      const std::int32_t twin = topology_.twins[h];
      halfedges_[h] = twin >= 0 && twin < h ? halfedges_[twin] + 1 : 2 * static_cast<std::int32_t>(edge_count_++);
    }
  }

  void fill_faces() {
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles_.size()); ++t) {
      const bool reversed = reversed_[t] != 0;
      const FaceHandle face(t);
      for (std::int32_t i = 0; i < 3; ++i) {
        const HalfedgeHandle inner(halfedges_[3 * t + i]);
        const VertexHandle from = vertex_at(3 * t + (reversed ? (i + 1) % 3 : i));
        const VertexHandle to = vertex_at(3 * t + (reversed ? i : (i + 1) % 3));
        mesh_.set_vertex_handle(inner, to);
        mesh_.set_face_handle(inner, face);
        mesh_.set_next_halfedge_handle(inner, HalfedgeHandle(halfedges_[3 * t + (i + (reversed ? 2 : 1)) % 3]));
        mesh_.set_halfedge_handle(from, inner);
        if (topology_.twins[3 * t + i] < 0) {
          const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(inner);
          mesh_.set_vertex_handle(outer, from);
          mesh_.set_boundary(outer);
        }
      }
      mesh_.set_halfedge_handle(face, HalfedgeHandle(halfedges_[3 * static_cast<std::size_t>(t)]));
    }
  }

  /// Links the outer halfedges around each fan's gap; they are the outgoing ones of their vertices, as OpenMesh wants.
  void close_boundaries() {
    for (std::size_t h = 0; h < halfedges_.size(); ++h) {
      if (topology_.twins[h] < 0) {
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
  const TriangleTopology& topology_;
  std::span<const std::uint8_t> reversed_;
  HalfedgeMesh& result_;
  TriangleMesh& mesh_;
  std::unordered_map<std::int32_t, std::int32_t> fan_vertex_;  ///< of the corners of vertices with several fans
  std::vector<std::int32_t> halfedges_;                        ///< the mesh's halfedge of each triangle halfedge
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
                                 const TriangleTopology& topology, std::span<const std::uint8_t> reversed) {
  HalfedgeMesh result;
  Builder(triangles, topology, reversed, result).build(xyz);
  return result;
}

OneRings one_rings(const TriangleMesh& mesh, std::span<const std::uint8_t> fixed,
                   std::span<const std::uint8_t> reversed, Workers& workers, std::span<const std::int32_t> copies_of) {
  constexpr std::int64_t grain = 16384;
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

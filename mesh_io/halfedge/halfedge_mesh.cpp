#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <unordered_set>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/prefix_sums.h"
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
          HalfedgeMesh& result, Workers& workers)
      : triangles_(triangles),
        sides_(sides),
        reversed_(reversed),
        result_(result),
        mesh_(result.mesh),
        workers_(workers) {}

  void build(std::span<const double> xyz) {
    check_halfedge_mesh_size(sides_.vertex_count, std::ssize(triangles_), count_unpaired());
    number_edges();
    mesh_.resize(static_cast<std::size_t>(sides_.vertex_count), edge_count_, triangles_.size());
    fill_faces();
    fill_vertices(xyz);
    result_.hold = sides_.hold;
    mark_fans(mesh_, result_.hold, workers_);
    if (std::ranges::any_of(result_.hold, [](std::uint8_t reasons) { return (reasons & hold::bow_tie) != 0; })) {
      split_fans();
    }
    close_boundaries();
  }

 private:
  std::int64_t count_unpaired() {
    std::atomic<std::int64_t> unpaired{0};
    workers_.for_blocks(std::ssize(sides_.twins), grain, [&](std::int64_t begin, std::int64_t end) {
      unpaired.fetch_add(std::count_if(sides_.twins.begin() + begin, sides_.twins.begin() + end,
                                       [](std::int32_t twin) { return twin < 0; }),
                         std::memory_order_relaxed);
    });
    return unpaired;
  }

  /// Numbers the edges in the order in which triangles first meet them.
  void number_edges() {
    const auto is_first = [this](std::int64_t h) { return sides_.twins[h] < 0 || sides_.twins[h] > h; };
    halfedges_.resize(sides_.twins.size());
    edge_count_ = static_cast<std::size_t>(for_each_numbered(
        std::ssize(halfedges_), is_first,
        [&](std::int64_t number, std::int64_t h) { halfedges_[h] = static_cast<std::int32_t>(2 * number); }, workers_));
    workers_.for_blocks(std::ssize(halfedges_), grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t h = begin; h < end; ++h) {
        if (!is_first(h)) {
          halfedges_[h] = halfedges_[sides_.twins[h]] + 1;
        }
      }
    });
  }

  /// Every halfedge of the mesh is one triangle's: that of a side, or the outer one beside it.
  void fill_faces() {
    workers_.for_blocks(std::ssize(triangles_), grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto t = static_cast<std::int32_t>(begin); t < end; ++t) {
        fill_face(t);
      }
    });
  }

  void fill_face(std::int32_t t) {
    const bool reversed = reversed_[t] != 0;
    const FaceHandle face(t);
    for (std::int32_t i = 0; i < 3; ++i) {
      const HalfedgeHandle inner(halfedges_[3 * t + i]);
      const VertexHandle from(triangles_[t][reversed ? (i + 1) % 3 : i]);
      const VertexHandle to(triangles_[t][reversed ? i : (i + 1) % 3]);
      mesh_.set_vertex_handle(inner, to);
      mesh_.set_face_handle(inner, face);
      mesh_.set_next_halfedge_handle(inner, HalfedgeHandle(halfedges_[3 * t + (i + (reversed ? 2 : 1)) % 3]));
      if (sides_.twins[3 * t + i] < 0) {
        const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(inner);
        mesh_.set_vertex_handle(outer, from);
        mesh_.set_boundary(outer);
      }
    }
    mesh_.set_halfedge_handle(face, HalfedgeHandle(halfedges_[3 * static_cast<std::size_t>(t)]));
  }

  /// A vertex begins with the halfedge that leaves it in its lowest triangle.
  void fill_vertices(std::span<const double> xyz) {
    workers_.for_blocks(sides_.vertex_count, grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        const VertexHandle vertex(v);
        const double* const point = xyz.data() + 3 * static_cast<std::size_t>(v);
        mesh_.set_point(vertex, {point[0], point[1], point[2]});
        if (const std::int32_t corner = sides_.corner[v]; corner >= 0) {
          mesh_.set_halfedge_handle(vertex, leaving(corner));
        }
      }
    });
  }

  /// The halfedge that leaves the vertex of a triangle's corner within the triangle.
  HalfedgeHandle leaving(std::int32_t corner) const {
    const std::int32_t t = corner / 3;
    return HalfedgeHandle(halfedges_[reversed_[t] != 0 ? 3 * t + (corner + 2) % 3 : corner]);
  }

  /// Gives every fan of a vertex but the first a vertex of its own.
  void split_fans() {
    std::unordered_set<std::int32_t> begun;  // vertices whose first fan is done
    std::unordered_set<int> done;            // halfedges that leave such a vertex
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(3 * triangles_.size()); ++corner) {
      const std::int32_t t = corner / 3;
      const std::int32_t v = triangles_[t][corner % 3];
      const HalfedgeHandle first = leaving(corner);
      if ((result_.hold[v] & hold::bow_tie) == 0 || done.contains(first.idx())) {
        continue;
      }
      const VertexHandle vertex = begun.insert(v).second ? VertexHandle(v) : copy_of(v);
      for_each_of_fan(mesh_, first, [&](HalfedgeHandle h) {
        done.insert(h.idx());
        mesh_.set_vertex_handle(mesh_.prev_halfedge_handle(h), vertex);
        if (mesh_.is_boundary(mesh_.opposite_halfedge_handle(h))) {
          mesh_.set_vertex_handle(mesh_.opposite_halfedge_handle(h), vertex);
        }
      });
      mesh_.set_halfedge_handle(vertex, first);
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
    // An outer halfedge is the one that leaves its vertex, and the one before its next.
    workers_.for_blocks(std::ssize(halfedges_), grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t h = begin; h < end; ++h) {
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
    });
  }

  std::span<const Triangle> triangles_;
  const MatchedSides& sides_;
  std::span<const std::uint8_t> reversed_;
  HalfedgeMesh& result_;
  TriangleMesh& mesh_;
  Workers& workers_;
  BulkVector<std::int32_t> halfedges_;  ///< the mesh's halfedge of each triangle halfedge
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
  Builder(triangles, sides, reversed, result, workers).build(xyz);
  return result;
}

void mark_fans(const TriangleMesh& mesh, std::span<std::uint8_t> hold, Workers& workers) {
  workers.for_blocks(std::ssize(hold), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<int>(begin); v < end; ++v) {
      hold[static_cast<std::size_t>(v)] |= mesh.is_isolated(VertexHandle(v)) ? hold::isolated : std::uint8_t{0};
    }
  });
  std::atomic<std::int64_t> in_fans{0};
  // In the order of the halfedges, as in one_rings().
  const auto for_first_fans = [&](const auto& visit) {
    workers.for_blocks(static_cast<std::int64_t>(mesh.n_halfedges()), grain, [&](std::int64_t begin, std::int64_t end) {
      std::int64_t corners = 0;
      for (auto h = static_cast<int>(begin); h < end; ++h) {
        const VertexHandle v = mesh.from_vertex_handle(HalfedgeHandle(h));
        if (mesh.halfedge_handle(v).idx() == h) {
          const HalfedgeHandle first = mesh.is_boundary(HalfedgeHandle(h))
                                           ? mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(HalfedgeHandle(h)))
                                           : HalfedgeHandle(h);
          std::int32_t size = 0;
          for_each_of_fan(mesh, first, [&](HalfedgeHandle) { ++size; });
          corners += size;
          visit(static_cast<std::size_t>(v.idx()), size);
        }
      }
      in_fans.fetch_add(corners, std::memory_order_relaxed);
    });
  };
  for_first_fans([](std::size_t /*v*/, std::int32_t /*size*/) {});
  if (in_fans == 3 * static_cast<std::int64_t>(mesh.n_faces())) {
    return;
  }
  // There are corners outside of the first fans of their vertices.
  std::vector<std::int32_t> faces(hold.size(), 0);
  workers.for_blocks(static_cast<std::int64_t>(mesh.n_halfedges()), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto h = static_cast<int>(begin); h < end; ++h) {
      if (!mesh.is_boundary(HalfedgeHandle(h))) {
        std::atomic_ref(faces[static_cast<std::size_t>(mesh.from_vertex_handle(HalfedgeHandle(h)).idx())])
            .fetch_add(1, std::memory_order_relaxed);
      }
    }
  });
  for_first_fans([&](std::size_t v, std::int32_t size) {
    if (size != faces[v]) {
      hold[v] |= hold::bow_tie;
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
  for_free_vertices([&](int v, HalfedgeHandle first) {
    HalfedgeHandle h = first;
    do {
      ++sizes[static_cast<std::size_t>(v)];
      h = rotated(h);
    } while (h != first);
  });
  OneRings rings = OneRings::with_sizes(
      static_cast<std::int32_t>(fixed.size()), [&](std::int32_t v) { return sizes[v]; }, workers);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/prefetch.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"

namespace trismooth {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

constexpr std::int64_t rows_a_task = 16384;

/// Calls visit(halfedge) for each halfedge of a face that leaves the vertex of `first`, which is one of them, as far as
/// faces follow each other around it. Asks nothing of the halfedges outside.
template <class Visit>
void for_each_of_fan(const ElementMesh& mesh, HalfedgeHandle first, Visit visit) {
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

template <class Corners>
class Builder {
 public:
  Builder(std::span<const Corners> elements, TriangleTopology& topology, std::span<const std::uint8_t> reversed,
          HalfedgeMesh& result, Workers& workers)
      : elements_(elements),
        topology_(topology),
        reversed_(reversed),
        result_(result),
        mesh_(result.mesh),
        workers_(workers) {}

  void build(std::span<const double> xyz) {
    const std::int64_t edges = number_edges();
    const std::int64_t quadrilaterals = ElementList(elements_).count_quadrilaterals();
    const std::int64_t triangles = std::ssize(elements_) - quadrilaterals;
    // Each edge has two halfedges: those of its elements, or of its only element and the outer one beside it.
    check_halfedge_mesh_size(topology_.vertex_count, triangles, 2 * edges - 3 * triangles - 4 * quadrilaterals,
                             quadrilaterals);
    make_room(static_cast<std::size_t>(edges));
    fill_faces();
    fill_vertices(xyz);
    if (std::ranges::any_of(topology_.hold, [](std::uint8_t reasons) { return (reasons & hold::bow_tie) != 0; })) {
      split_fans();
    }
    close_boundaries();
  }

 private:
  using Elements = std::span<const Corners>;
  static constexpr std::int32_t most = sides_of<Elements>;

  /// Whether the element has it: a triangle among quadrilaterals has no fourth one.
  bool is_side(std::int64_t side) const { return side % most < corner_count(elements_[side / most]); }

  /// Numbers the edges in the order in which elements first meet them, and returns how many there are. The sides'
  /// twins are not needed any more then, and go.
  std::int64_t number_edges() {
    const BulkVector<std::int32_t> twins = std::move(topology_.twins);
    halfedges_.resize(twins.size());
    return for_each_numbered(
        std::ssize(halfedges_), [&](std::int64_t h) { return is_side(h) && (twins[h] < 0 || twins[h] > h); },
        [&](std::int64_t number, std::int64_t h) {
          const auto first = static_cast<std::int32_t>(2 * number);
          if (twins[h] < 0) {
            halfedges_[h] = beside_outer(first);
          } else {
            halfedges_[h] = first;
            halfedges_[twins[h]] = first + 1;
          }
        },
        workers_);
  }

  /// How halfedges_ says that the halfedge has an outer one beside it; and back.
  static std::int32_t beside_outer(std::int32_t halfedge) { return ~halfedge; }
  static bool is_beside_outer(std::int32_t halfedge) { return halfedge < 0; }
  HalfedgeHandle inner(std::int64_t side) const {
    const std::int32_t halfedge = halfedges_[side];
    return HalfedgeHandle(is_beside_outer(halfedge) ? ~halfedge : halfedge);
  }

  /// The elements, in large pages where the system has them: what follows reads them here and there.
  void make_room(std::size_t edges) {
    const auto vertices = static_cast<std::size_t>(topology_.vertex_count);
    if (vertices == 0 || edges == 0) {
      mesh_.resize(vertices, edges, elements_.size());
      return;
    }
    mesh_.reserve(vertices, edges, elements_.size());
    mesh_.resize(1, 1, 1);
    prefer_large_pages(&mesh_.edge(OpenMesh::EdgeHandle(0)), edges * sizeof(mesh_.edge(OpenMesh::EdgeHandle(0))));
    prefer_large_pages(&mesh_.point(VertexHandle(0)), vertices * sizeof(ElementMesh::Point));
    mesh_.resize(vertices, edges, elements_.size());
  }

  /// Every halfedge of the mesh is one element's: that of a side, or the outer one beside it.
  void fill_faces() {
    workers_.for_blocks(std::ssize(elements_), rows_a_task, [&](std::int64_t begin, std::int64_t end) {
      for (auto e = static_cast<std::int32_t>(begin); e < end; ++e) {
        fill_face(e);
      }
    });
  }

  void fill_face(std::int32_t e) {
    const bool reversed = reversed_[e] != 0;
    const FaceHandle face(e);
    const Corners& corners = elements_[e];
    const std::int32_t count = corner_count(corners);
    const std::int64_t first = most * std::int64_t{e};
    for (std::int32_t i = 0; i < count; ++i) {
      const HalfedgeHandle side = inner(first + i);
      const VertexHandle from(corners[reversed ? (i + 1) % count : i]);
      const VertexHandle to(corners[reversed ? i : (i + 1) % count]);
      mesh_.set_vertex_handle(side, to);
      mesh_.set_face_handle(side, face);
      mesh_.set_next_halfedge_handle(side, inner(first + (i + (reversed ? count - 1 : 1)) % count));
      if (is_beside_outer(halfedges_[first + i])) {
        const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(side);
        mesh_.set_vertex_handle(outer, from);
        mesh_.set_boundary(outer);
      }
    }
    mesh_.set_halfedge_handle(face, inner(first));
  }

  /// A vertex begins with the halfedge that leaves it in its lowest element.
  void fill_vertices(std::span<const double> xyz) {
    workers_.for_blocks(topology_.vertex_count, rows_a_task, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        const VertexHandle vertex(v);
        const double* const point = xyz.data() + 3 * static_cast<std::size_t>(v);
        mesh_.set_point(vertex, {point[0], point[1], point[2]});
        if (const std::int32_t corner = topology_.corner[v]; corner >= 0) {
          mesh_.set_halfedge_handle(vertex, leaving(corner));
        }
      }
    });
  }

  /// The halfedge that leaves the vertex of an element's corner within the element.
  HalfedgeHandle leaving(std::int32_t corner) const {
    return inner(reversed_[corner / most] != 0 ? halfedge_before(elements_, corner) : corner);
  }

  /// Gives every fan of a vertex but the first a vertex of its own.
  void split_fans() {
    std::unordered_set<std::int32_t> begun;  // vertices whose first fan is done
    std::unordered_set<int> done;            // halfedges that leave such a vertex
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(most * elements_.size()); ++corner) {
      if (!is_side(corner)) {
        continue;
      }
      const std::int32_t v = start_of(elements_, corner);
      const HalfedgeHandle first = leaving(corner);
      if ((topology_.hold[v] & hold::bow_tie) == 0 || done.contains(first.idx())) {
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
    workers_.for_blocks(std::ssize(halfedges_), rows_a_task, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t h = begin; h < end; ++h) {
        if (is_side(h) && is_beside_outer(halfedges_[h])) {
          const HalfedgeHandle outer = mesh_.opposite_halfedge_handle(inner(h));
          HalfedgeHandle leaving = inner(h);
          while (!mesh_.is_boundary(leaving)) {
            leaving = mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(leaving));
          }
          mesh_.set_next_halfedge_handle(outer, leaving);
          mesh_.set_halfedge_handle(mesh_.from_vertex_handle(outer), outer);
        }
      }
    });
  }

  Elements elements_;
  TriangleTopology& topology_;
  std::span<const std::uint8_t> reversed_;
  HalfedgeMesh& result_;
  ElementMesh& mesh_;
  Workers& workers_;
  BulkVector<std::int32_t> halfedges_;  ///< the mesh's halfedge of each side of an element: see beside_outer()
};

}  // namespace

void check_halfedge_mesh_size(std::int64_t vertices, std::int64_t triangles, std::int64_t unpaired_sides,
                              std::int64_t quadrilaterals) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (vertices > most) {
    throw MeshError("more than " + std::to_string(most) +
                    " vertices in the halfedge mesh, where a vertex of several fans is one for each");
  }
  // Two halfedges an edge: each side of an element is one, and those that are not paired have another beside them.
  const std::int64_t halfedges = 3 * triangles + 4 * quadrilaterals + unpaired_sides;
  if (halfedges > most) {
    const std::string of_quadrilaterals =
        quadrilaterals > 0 ? ", four for each of " + std::to_string(quadrilaterals) + " quadrilaterals" : "";
    throw MeshError("more than " + std::to_string(most) + " halfedges: three for each of " + std::to_string(triangles) +
                    " triangles" + of_quadrilaterals + ", and " + std::to_string(unpaired_sides) + " on the boundary");
  }
}

HalfedgeMesh build_halfedge_mesh(std::span<const double> xyz, const ElementList& elements, TriangleTopology& topology,
                                 std::span<const std::uint8_t> reversed, Workers& workers) {
  HalfedgeMesh result;
  result.may_have_quadrilaterals = !elements.are_triangles();
  elements.visit([&](const auto& listed) { Builder(listed, topology, reversed, result, workers).build(xyz); });
  return result;
}

OneRings one_rings(const HalfedgeMesh& halfedges, std::span<const std::int32_t> degree,
                   std::span<const std::uint8_t> fixed, std::span<const std::uint8_t> reversed, Workers& workers) {
  const ElementMesh& mesh = halfedges.mesh;
  OneRings rings = OneRings::with_sizes(
      static_cast<std::int32_t>(fixed.size()), [&](std::int32_t v) { return fixed[v] == 0 ? degree[v] : 0; }, workers);
  if (halfedges.may_have_quadrilaterals) {
    rings.opposites.resize(rings.neighbours.size());
  }
  // In the order of the halfedges, which lie as the file lists its elements: with more locality than its vertices.
  constexpr std::int64_t bits = 64;
  std::vector<std::uint64_t> is_first(mesh.n_halfedges() / bits + 1, 0);
  workers.for_blocks(std::ssize(fixed), rows_a_task, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<int>(begin); v < end; ++v) {
      if (fixed[v] == 0) {
        const int first = mesh.halfedge_handle(VertexHandle(v)).idx();
        set_bits_relaxed(is_first[first / bits], std::uint64_t{1} << static_cast<unsigned>(first % bits));
      }
    }
  });
  const auto end_of = [&](HalfedgeHandle h) {
    const auto v = static_cast<std::size_t>(mesh.to_vertex_handle(h).idx());
    return v < fixed.size() ? static_cast<std::int32_t>(v) : halfedges.copies_of[v - fixed.size()];
  };
  // The vertex opposite of where the halfedge begins, in its face of four sides.
  const auto opposite_in_face = [&](HalfedgeHandle h) {
    const HalfedgeHandle next = mesh.next_halfedge_handle(h);
    return mesh.next_halfedge_handle(next) == mesh.prev_halfedge_handle(h) ? no_corner : end_of(next);
  };
  const auto fill = [&](HalfedgeHandle first) {
    const bool clockwise = !reversed.empty() && reversed[mesh.face_handle(first).idx()] != 0;
    const auto step = [&](HalfedgeHandle h) {
      const HalfedgeHandle arriving = mesh.opposite_halfedge_handle(clockwise ? h : mesh.prev_halfedge_handle(h));
      return clockwise ? mesh.next_halfedge_handle(arriving) : arriving;
    };
    const std::int32_t vertex = mesh.from_vertex_handle(first).idx();
    if (halfedges.may_have_quadrilaterals) {
      rings.fill_mixed(vertex, [&, h = first]() mutable {
        const HalfedgeHandle here = std::exchange(h, step(h));
        return std::pair(end_of(here), opposite_in_face(clockwise ? h : here));
      });
    } else {
      rings.fill(vertex, [&, h = first]() mutable { return end_of(std::exchange(h, step(h))); });
    }
  };
  const auto for_word = [&](std::int64_t word, const auto& visit) {
    for (std::uint64_t left = is_first[word]; left != 0; left &= left - 1) {
      visit(HalfedgeHandle(static_cast<int>(bits * word + std::countr_zero(left))));
    }
  };
  const auto offset = [&](HalfedgeHandle first) -> const std::int64_t& {
    return rings.offsets[static_cast<std::size_t>(mesh.from_vertex_handle(first).idx())];
  };
  workers.for_blocks(std::ssize(is_first), rows_a_task / bits, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t word = begin; word < end; ++word) {
      // Vertices may be numbered at random: what is of them alone is asked for before it is needed.
      if (word + 2 < end) {
        for_word(word + 2, [&](HalfedgeHandle first) { prefetch(&offset(first)); });
      }
      if (word + 1 < end) {
        for_word(word + 1, [&](HalfedgeHandle first) { prefetch(rings.neighbours.data() + offset(first)); });
      }
      for_word(word, fill);
    }
  });
  return rings;
}

}  // namespace trismooth

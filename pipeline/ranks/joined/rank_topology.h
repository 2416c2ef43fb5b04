// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/pipeline/ranks/joined/rank_mesh.h"

namespace trismooth {

/// How the whole mesh hangs together, as far as a rank needs it to report on it: the vertices that it owns with all of
/// their elements. What is said of triangles holds for quadrilaterals.
class RankTopology {
 public:
  /// `named`: one flag a vertex of `mesh`, not zero where the user holds it. `owners`: as mpi::LocalMesh has them.
  /// Throws ReadError naming `path` on all ranks for triangles that are no mesh. Collective.
  RankTopology(const RankMesh& mesh, std::span<const std::uint8_t> named, std::span<const std::int32_t> owners,
               const std::filesystem::path& path, std::shared_ptr<const mpi::Communicator> ranks, Workers& workers);

  /// Finds how the elements hang together: what is found by topology() can be asked for then. Throws as the constructor
  /// does. Collective.
  void connect(const std::filesystem::path& path, Workers& workers);

  /// The ranks. Local.
  const mpi::Communicator& ranks() const { return *ranks_; }
  /// The rank's vertices with their triangles. Local.
  const mpi::Overlap& overlap() const { return overlap_; }
  /// How the triangles of the overlap hang together. Local.
  const TriangleTopology& topology() const { return topology_; }

  /// What the vertices of the overlap have, from what those of the rank's mesh do. Who has a vertex says the same, or
  /// numbers whose bits are joined. Collective.
  template <class V>
  std::vector<V> of_vertices(std::span<const V> values) const {
    std::vector<V> all(overlap_.ids.size());
    const auto join = [](std::int32_t /*v*/, V& value, const V& other) {
      if constexpr (std::is_integral_v<V>) {
        value = static_cast<V>(value | other);
      } else {
        value = other;
      }
    };
    Workers one(1);
    overlap_.callers.bring_to_owners(values, std::span(all), join, *ranks_, one);
    mpi::GhostValues(overlap_.part).update(std::span(all));
    return all;
  }

  /// How many vertices of the whole mesh have a flag that is not zero. `flags`: one a vertex of the rank's mesh.
  /// Collective.
  std::int64_t count_vertices(std::span<const std::uint8_t> flags) const;

  /// Elements of the whole mesh. Local.
  std::int64_t triangle_count() const { return triangle_count_; }
  /// Elements of the rank's mesh that are no copies. Local.
  std::size_t own_triangles() const { return own_count_; }
  /// The number of one of these in the whole mesh; it ascends. Local.
  std::int64_t own_id(std::size_t own_triangle) const {
    return triangle_ids_.empty() ? first_id_ + static_cast<std::int64_t>(own_triangle) : triangle_ids_[own_triangle];
  }
  /// The triangle of the rank's mesh whose number in the whole mesh that is; -1: it is none of its own. Local.
  std::int32_t local_triangle(std::int64_t id) const;
  /// Whether this rank is the one of those that have the triangle which counts it. Local.
  bool counts(std::size_t element) const { return overlap_.counts(element); }

  /// Why each vertex of the overlap is held, bits of namespace hold. `regions`: one number a triangle of the overlap;
  /// empty: there are none. Collective.
  std::vector<std::uint8_t> held(std::span<const std::int32_t> regions, Workers& workers) const;
  /// The local frame of the vertices that cells use. Collective.
  LocalFrame frame_of(std::span<const Point2<double>> points, std::span<const std::uint8_t> held) const;
  /// One flag a triangle of the overlap: 1 where it is listed clockwise in the consistent orientation. Collective.
  std::vector<std::uint8_t> reversed(std::span<const Point2<double>> local, Workers& workers) const;

  /// Hands out the overlap, with those regions of triangles and what is held for all of these reasons, for who
  /// smooths it, and gives up topology() and all that is found by it: held(), reversed(). Local.
  mpi::Overlap lend_overlap(std::vector<std::int32_t> regions, std::span<const std::uint8_t> held);
  /// Takes the overlap back: all that is asked of it can be asked again. Local.
  void take_back(mpi::Overlap overlap) { overlap_ = std::move(overlap); }

 private:
  std::shared_ptr<const mpi::Communicator> ranks_;
  mpi::Overlap overlap_;
  TriangleTopology topology_;
  std::size_t own_count_ = 0;
  std::vector<std::int32_t> own_places_;  ///< in the rank's mesh, of those that are no copies; empty: all are none
  SharedNumbers triangle_ids_;            ///< as RankMesh has them
  std::int64_t first_id_ = 0;             ///< the number of the first of its own where ids are not known
  std::int64_t triangle_count_ = 0;
};

}  // namespace trismooth

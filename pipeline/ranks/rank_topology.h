#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/pipeline/ranks/rank_mesh.h"

namespace trismooth {

/// How the whole mesh hangs together, as far as a rank needs it to report on it: the vertices that it owns with all of
/// their triangles. All functions are collective unless they say otherwise.
class RankTopology {
 public:
  /// `named`: one flag a vertex of `mesh`, not zero where the user holds it. `owners`: as mpi::LocalMesh has them.
  /// Throws ReadError naming `path` on all ranks for triangles that are no mesh.
  RankTopology(const RankMesh& mesh, std::span<const std::uint8_t> named, std::span<const std::int32_t> owners,
               const std::filesystem::path& path, std::shared_ptr<const mpi::Communicator> ranks, Workers& workers);

  const mpi::Communicator& ranks() const { return *ranks_; }
  const mpi::Overlap& overlap() const { return overlap_; }
  const TriangleTopology& topology() const { return topology_; }

  /// What the vertices of the overlap have, from what those of the rank's mesh do. Who has a vertex says the same, or
  /// numbers whose bits are joined.
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

  /// What the triangles of the overlap have, from what those of the rank's mesh do; copies have no say.
  template <class V>
  std::vector<V> of_triangles(std::span<const V> values) const {
    mpi::ByRank<V> answers = mpi::lists_by_rank<V>(*ranks_);
    for (std::size_t r = 0; r < answers.size(); ++r) {
      for (const std::int32_t t : asked_triangles_[r]) {
        answers[r].push_back(values[static_cast<std::size_t>(t)]);
      }
    }
    const mpi::ByRank<V> told = ranks_->exchanged(answers);
    std::vector<V> all(overlap_.triangles.size());
    for (std::size_t r = 0; r < told.size(); ++r) {
      for (std::size_t i = 0; i < told[r].size(); ++i) {
        all[static_cast<std::size_t>(wanted_triangles_[r][i])] = told[r][i];
      }
    }
    return all;
  }

  /// Triangles of the whole mesh, and those that come before this rank's.
  std::int64_t triangle_count() const { return triangle_count_; }
  /// The triangle of the rank's mesh whose number in the whole mesh that is; -1: it is none of its own. Not collective.
  std::int32_t local_triangle(std::int64_t id) const;
  /// Whether this rank is the one of those that have the triangle which counts it. Not collective.
  bool counts(std::size_t triangle) const;

  /// Why each vertex of the overlap is held, bits of namespace hold. `regions`: one number a triangle of the overlap;
  /// empty: there are none.
  std::vector<std::uint8_t> held(std::span<const std::int32_t> regions, Workers& workers) const;
  /// The local frame of the vertices that cells use.
  LocalFrame frame_of(std::span<const Point2<double>> points, std::span<const std::uint8_t> held) const;
  /// One flag a triangle of the overlap: 1 where it is listed clockwise in the consistent orientation.
  std::vector<std::uint8_t> reversed(std::span<const Point2<double>> local, Workers& workers) const;

 private:
  /// For each triangle of the overlap the rank in whose pieces it is.
  std::vector<std::int32_t> holders_of_triangles() const;
  void ask_for_triangles();

  std::shared_ptr<const mpi::Communicator> ranks_;
  mpi::Overlap overlap_;
  TriangleTopology topology_;
  std::vector<std::int32_t> own_triangles_;  ///< of the rank's mesh, those that are no copies
  std::vector<std::int64_t> own_ids_;        ///< the numbers of these in the whole mesh, ascending
  std::int64_t triangle_count_ = 0;
  mpi::ByRank<std::int32_t> wanted_triangles_;  ///< of the overlap, by the rank in whose pieces they are
  mpi::ByRank<std::int32_t> asked_triangles_;   ///< of the rank's mesh, by the rank that wants to know
};

}  // namespace trismooth

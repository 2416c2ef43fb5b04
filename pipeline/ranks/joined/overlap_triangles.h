// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"

namespace trismooth {

/// The way from the triangles of the ranks' meshes to those of their overlaps.
class OverlapTriangles {
 public:
  /// The topology outlives it. Ranks agree on the way where it is first needed. Local.
  explicit OverlapTriangles(const RankTopology& topology) : topology_(topology), ranks_(topology.ranks()) {}

  /// What the triangles of the overlap have, from what those of the rank's mesh do; copies have no say. Collective.
  template <class V>
  std::vector<V> of_overlap(std::span<const V> values) {
    if (!lists_) {
      lists_ = find_lists();
    }
    mpi::ByRank<V> answers = mpi::lists_by_rank<V>(ranks_);
    for (std::size_t r = 0; r < answers.size(); ++r) {
      answers[r].reserve(lists_->asked[r].size());
      for (const std::int32_t t : lists_->asked[r]) {
        answers[r].push_back(values[static_cast<std::size_t>(t)]);
      }
    }
    const mpi::ByRank<V> told = ranks_.exchanged(std::move(answers));
    std::vector<V> all(topology_.overlap().elements().size());
    for (std::size_t r = 0; r < told.size(); ++r) {
      for (std::size_t i = 0; i < told[r].size(); ++i) {
        all[static_cast<std::size_t>(lists_->wanted[r][i])] = told[r][i];
      }
    }
    return all;
  }

 private:
  struct Lists {
    mpi::ByRank<std::int32_t> wanted;  ///< triangles of the overlap, by the rank in whose pieces they are
    mpi::ByRank<std::int32_t> asked;   ///< triangles of the rank's mesh, by the rank that wants to know
  };

  /// Collective.
  Lists find_lists() const;
  /// For each triangle of the overlap the rank in whose pieces it is. Collective.
  std::vector<std::int32_t> holders() const;

  const RankTopology& topology_;
  const mpi::Communicator& ranks_;
  std::optional<Lists> lists_;
};

}  // namespace trismooth

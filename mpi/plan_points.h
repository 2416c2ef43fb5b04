// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::mpi {

/// What the callers hand in of their vertices in a call, brought to the vertices of the overlaps, and what is handed
/// back to them. Functions throw on all ranks what is wrong on one or between them.
class PlanPoints {
 public:
  /// All of these outlive it. Local.
  PlanPoints(const Overlap& overlap, GhostValues& ghosts, const Communicator& ranks, Workers& workers)
      : overlap_(overlap), ghosts_(ghosts), ranks_(ranks), workers_(workers) {}

  /// x and y of the overlap's vertices. Throws MeshError for a number that is not finite, std::invalid_argument for
  /// another number of points than there are local vertices and for points that ranks disagree about. Collective.
  BulkVector<Point2<double>> gathered(const ConstPointView& points) const;

  /// What is stored as: float where the points are, else `asked`; on ranks without vertices what it is on the others.
  /// Throws std::invalid_argument where ranks with vertices differ in that. Collective.
  Storage storage_of(const ConstPointView& points, Storage asked) const;

  /// Throws MeshError where points have heights and these are not the same everywhere: require_one_height() over all
  /// ranks. std::invalid_argument where ranks with vertices differ in whether there are any, or in one. `gathered`: as
  /// above; `fixed`: bits of namespace hold, one a vertex of the overlap. Collective.
  void require_one_height(const ConstPointView& points, std::span<const Point2<double>> gathered,
                          std::span<const std::uint8_t> fixed) const;

  /// Target lengths of the overlap's vertices, 1 where nobody says anything. `lengths`: one for each local vertex, or
  /// none. Throws std::invalid_argument for another number of them, for what ranks disagree about, and where `are_used`
  /// for what is no positive number. `fixed`: bits of namespace hold, one a vertex of the overlap; vertices that no
  /// triangle uses may have anything. Collective.
  std::vector<double> target_lengths(std::span<const double> lengths, std::span<const std::uint8_t> fixed,
                                     bool are_used) const;

  /// Writes the caller's points, from those of the overlap. Collective.
  void hand_back(std::span<const Point2<double>> all, const PointView& points) const;

 private:
  template <class V, class Join>
  void gather(std::span<const V> local, std::span<V> all, const Join& join) const {
    overlap_.callers.bring_to_owners(local, all, join, ranks_, workers_);
    ghosts_.update(all);
  }
  std::string name_of(std::int32_t v) const;

  const Overlap& overlap_;
  GhostValues& ghosts_;
  const Communicator& ranks_;
  Workers& workers_;
};

}  // namespace trismooth::mpi

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/overlap.h"

namespace trismooth::mpi {

/// What a component of a rank's overlap is called.
struct ComponentLabel {
  std::int64_t triangle;
  std::uint8_t parity;  ///< 1 where the lowest element here is listed against that of the label
};

/// A component here and one on another rank that have an element in common.
struct ComponentJoin {
  std::int32_t own;
  std::int32_t other;
  std::uint8_t parity;  ///< 1 where their lowest elements are listed against each other

  /// A key that both ranks give the join. Local.
  [[nodiscard]] std::tuple<std::int32_t, std::int32_t, std::uint8_t> key(bool own_first) const {
    return own_first ? std::tuple(own, other, parity) : std::tuple(other, own, parity);
  }
};

/// Which components of a rank's overlap are parts of the same component of the whole mesh. Each has the id of its
/// lowest element for a label.
class ComponentLabels {
 public:
  /// Of no element. Local.
  ComponentLabels() = default;

  /// `components`: those of the overlap, found without edges between two ghosts. Collective. Throws MeshError on all
  /// ranks for a component that cannot be oriented. Complexity: linear in what the rank has; rounds over all ranks grow
  /// with the square of the logarithm of how many parts of a component there are.
  ComponentLabels(const Overlap& overlap, const TriangleComponents& components, const Communicator& communicator);

  /// Orientation::reversed of every element of the overlap, as orient() finds it for the whole mesh. `points` are in
  /// the local frame. Collective.
  std::vector<std::uint8_t> reversed(const Overlap& overlap, const TriangleComponents& components,
                                     std::span<const Point2<double>> points, const Communicator& communicator,
                                     Workers& workers) const;

 private:
  /// What the other sides of the joins have for labels.
  ByRank<ComponentLabel> told_over(const std::vector<std::vector<ComponentJoin>>& joins,
                                   const Communicator& ranks) const;

  std::vector<ComponentLabel> labels_;
  std::vector<std::int64_t> to_homes_;    ///< how many of them have each rank for a home
  std::vector<std::int64_t> from_ranks_;  ///< how many of each rank have this one for a home
};

}  // namespace trismooth::mpi

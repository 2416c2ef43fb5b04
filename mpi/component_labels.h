#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/overlap.h"

namespace trismooth::mpi {

/// Which components of a rank's overlap are parts of the same component of the whole mesh. Each has the id of its lowest
/// triangle for a label.
class ComponentLabels {
 public:
  /// Of no triangle.
  ComponentLabels() = default;

  /// `components`: those of the overlap, found without edges between two ghosts. Collective. Throws MeshError on all
  /// ranks for a component that cannot be oriented. Labels go from rank to rank until none changes: the rounds are as
  /// many as ranks are passed, one after the other, on the way to a component's lowest triangle.
  ComponentLabels(const Overlap& overlap, const TriangleComponents& components, const Communicator& communicator);

  /// Orientation::reversed of every triangle of the overlap, as orient() finds it for the whole mesh. `points` are in the
  /// local frame. Collective.
  std::vector<std::uint8_t> reversed(const Overlap& overlap, const TriangleComponents& components,
                                     std::span<const Point2<double>> points, const Communicator& communicator,
                                     Workers& workers) const;

 private:
  struct Label {
    std::int64_t triangle;
    std::uint8_t parity;  ///< 1 where the lowest triangle here is listed against that of the label
  };

  std::vector<Label> labels_;
};

}  // namespace trismooth::mpi

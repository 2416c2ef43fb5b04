#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// Shares points out among the ranks by recursive coordinate bisection: the points of a group of ranks are cut across
/// the longer side of their box, so that each half of the group gets its part, until a group is one rank. Points at the
/// same place go to the same rank, whoever has them; those of all ranks are cut together, and no rank has them all.
/// Collective. Complexity: linear in the rank's points for each of log2(ranks) levels, times the 64 steps that finding
/// a cut takes.
std::vector<std::int32_t> bisected(std::span<const Point2<double>> points, const mpi::Communicator& ranks);

}  // namespace trismooth

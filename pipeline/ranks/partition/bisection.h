// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// How much more than its share the first half of a group of parts may have, which saves steps: that part of it, of
/// groups of no more than so many parts.
struct BisectionSlack {
  double part = 0;
  int most_parts = 0;
};

/// Shares points out among `parts` by recursive coordinate bisection: the points of a group of parts are cut across the
/// longer side of their box, so that each half of the group gets its share, until a group is one part. Points at the
/// same place get the same part, whoever has them; those of all ranks are cut together, and no rank has them all.
/// Collective. Complexity: linear in the rank's points for each of log2(parts) levels, times the steps that finding a
/// cut takes, 64 at most.
std::vector<std::int32_t> bisected(std::span<const Point2<double>> points, int parts, const mpi::Communicator& ranks,
                                   BisectionSlack slack = {});

}  // namespace trismooth

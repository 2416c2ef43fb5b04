// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "smoothing_checks.h"
#include "support/naive_smoothing.h"

namespace fuzz {

/// Points smoothed as the contract says it, by the second implementation: from the local frame over the sweeps to the
/// guard.
struct ByContract {
  std::vector<Point2<double>> points;  ///< as they would be stored
  naive::Outcome outcome;
  naive::Guarded guarded;
};

/// Knows no quality target, no time limit, no callback, and no endless run.
ByContract smooth_by_contract(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                              const NaiveTopology& topology, const trismooth::SmoothingOptions& options,
                              trismooth::Storage storage);

}  // namespace fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metric_lanes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "trismooth/base/machine/compiled_for.h"
#include "trismooth/quality/metric_formulas.h"

// One loop, which calls the formulas as they are for each lane.
namespace trismooth {

namespace {

constexpr std::size_t lanes = 32;

/// Triangles side by side, and the values of their metrics.
struct TriangleLanes {
  static constexpr std::size_t corner_count = std::tuple_size_v<CornerPoints>;

  alignas(64) double corners[2 * corner_count][lanes] = {};  ///< x and y of each
  alignas(64) double values[metric_count][lanes] = {};
};

[[gnu::always_inline]] inline void evaluate_lanes(TriangleLanes& triangles) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto& at = triangles.corners;
    const MetricValues values = metric_formulas::evaluate_all({at[0][lane], at[1][lane]}, {at[2][lane], at[3][lane]},
                                                              {at[4][lane], at[5][lane]});
    [&]<std::size_t... m>(std::index_sequence<m...>) {
      ((triangles.values[m][lane] = values[m]), ...);
    }
    (std::make_index_sequence<metric_count>());
  }
}

}  // namespace

void evaluate_all(std::span<const CornerPoints> triangles, std::span<MetricValues> values) {
  const auto evaluate = compiled_for<evaluate_lanes>();
  TriangleLanes side_by_side;
  for (std::size_t begin = 0; begin < triangles.size(); begin += lanes) {
    const std::size_t count = std::min(lanes, triangles.size() - begin);
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t corner = 0; corner < TriangleLanes::corner_count; ++corner) {
        side_by_side.corners[2 * corner][lane] = triangles[begin + lane][corner].x;
        side_by_side.corners[2 * corner + 1][lane] = triangles[begin + lane][corner].y;
      }
    }
    evaluate(side_by_side);
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t m = 0; m < metric_count; ++m) {
        values[begin + lane][m] = side_by_side.values[m][lane];
      }
    }
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metric_lanes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "trismooth/base/machine/compiled_for.h"
#include "trismooth/quality/metric_formulas.h"
#include "trismooth/quality/quadrilateral_formulas.h"

// One loop, which calls the formulas as they are for each lane.
namespace trismooth {

namespace {

constexpr std::size_t lanes = 32;

KindValues<CornerPoints> all_of(const CornerPoints& corners) {
  return metric_formulas::evaluate_all(corners);
}
KindValues<QuadrilateralPoints> all_of(const QuadrilateralPoints& corners) {
  return quadrilateral_formulas::evaluate_all(corners);
}

/// Elements side by side, and the values of their metrics.
template <class Points>
struct ElementsInLanes {
  static constexpr std::size_t corner_count = std::tuple_size_v<Points>;

  alignas(64) double corners[2 * corner_count][lanes] = {};  ///< x and y of each
  alignas(64) double values[count_of_metrics<Points>][lanes] = {};
};

template <class Points>
[[gnu::always_inline]] inline void evaluate_lanes(ElementsInLanes<Points>& elements) {
  constexpr std::size_t corners = ElementsInLanes<Points>::corner_count;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto& at = elements.corners;
    const auto points = [&]<std::size_t... i>(std::index_sequence<i...>) {
      return Points{Point2<double>{at[2 * i][lane], at[2 * i + 1][lane]}...};
    }
    (std::make_index_sequence<corners>());
    const KindValues<Points> values = all_of(points);
    [&]<std::size_t... m>(std::index_sequence<m...>) {
      ((elements.values[m][lane] = values[m]), ...);
    }
    (std::make_index_sequence<count_of_metrics<Points>>());
  }
}

template <class Points>
void evaluate_several(std::span<const Points> elements, std::span<KindValues<Points>> values) {
  constexpr std::size_t corners = ElementsInLanes<Points>::corner_count;
  const auto evaluate = compiled_for<evaluate_lanes<Points>>();
  ElementsInLanes<Points> side_by_side;
  for (std::size_t begin = 0; begin < elements.size(); begin += lanes) {
    const std::size_t count = std::min(lanes, elements.size() - begin);
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t corner = 0; corner < corners; ++corner) {
        side_by_side.corners[2 * corner][lane] = elements[begin + lane][corner].x;
        side_by_side.corners[2 * corner + 1][lane] = elements[begin + lane][corner].y;
      }
    }
    evaluate(side_by_side);
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t m = 0; m < count_of_metrics<Points>; ++m) {
        values[begin + lane][m] = side_by_side.values[m][lane];
      }
    }
  }
}

}  // namespace

void evaluate_all(std::span<const CornerPoints> elements, std::span<KindValues<CornerPoints>> values) {
  evaluate_several(elements, values);
}
void evaluate_all(std::span<const QuadrilateralPoints> elements, std::span<KindValues<QuadrilateralPoints>> values) {
  evaluate_several(elements, values);
}

}  // namespace trismooth

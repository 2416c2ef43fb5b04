// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/region_area.h"

#include <cmath>
#include <cstddef>

#include "trismooth/quality/corner_points.h"

namespace trismooth {

namespace {

struct CompensatedSum {
  double sum = 0;
  double lost = 0;

  void add(double value) {
    const double total = sum + value;
    lost += std::abs(sum) >= std::abs(value) ? (sum - total) + value : (value - total) + sum;
    sum = total;
  }
};

}  // namespace

std::vector<double> region_areas(const MeshView& view, std::span<const std::int32_t> region_of,
                                 std::int32_t region_count) {
  std::vector<CompensatedSum> sums(static_cast<std::size_t>(region_count));
  view.visit([&](const auto& elements) {
    for (std::size_t e = 0; e < elements.elements.size(); ++e) {
      CompensatedSum& sum = sums[region_of.empty() ? 0 : static_cast<std::size_t>(region_of[e])];
      sum.add(with_points(elements, e, [](const auto& corners) { return doubled_area(corners); }) / 2);
    }
  });
  std::vector<double> areas;
  areas.reserve(sums.size());
  for (const CompensatedSum& sum : sums) {
    areas.push_back(sum.sum + sum.lost);
  }
  return areas;
}

}  // namespace trismooth

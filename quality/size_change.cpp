#include "trismooth/quality/size_change.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Twice the area of triangle `index`, or NaN where it is not valid.
double doubled_valid_area(const TriangleView& view, std::size_t index) {
  const auto [i, j, k] = canonical_corners(view, index);
  const Point2<double> a = view.points[static_cast<std::size_t>(i)];
  const Point2<double> b = view.points[static_cast<std::size_t>(j)];
  const Point2<double> c = view.points[static_cast<std::size_t>(k)];
  return shape_quotient(a, b, c) > 0 ? cross(b - a, c - a) : nan;
}

using Values = std::vector<double>;

/// Where the smallest value that `percent` per cent do not exceed stands once all are sorted.
Values::iterator percentile(Values& values, std::size_t percent) {
  const std::size_t rank = (values.size() * percent + 99) / 100;
  return values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
}

}  // namespace

SizeChange size_change(const TriangleView& before, const TriangleView& after, int threads) {
  const std::size_t count = before.triangles.size();
  if (after.triangles.size() != count) {
    throw std::invalid_argument("size_change: the meshes have different triangles");
  }
  const double unit = std::ldexp(1.0, 2 * (after.exponent - before.exponent));
  Values ratios(count);
  // Blocks of one size whatever the number of threads, added up in their order: no rounding depends on scheduling.
  constexpr std::size_t block_size = 4096;
  std::vector<double> sums((count + block_size - 1) / block_size);
  Workers(threads).for_blocks(static_cast<std::int64_t>(sums.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
      const std::size_t last = std::min((block + 1) * block_size, count);
      for (std::size_t t = block * block_size; t < last; ++t) {
        ratios[t] = doubled_valid_area(after, t) / doubled_valid_area(before, t) * unit;
        if (!std::isnan(ratios[t])) {
          const double log_ratio = std::log(ratios[t]);
          sums[block] += log_ratio * log_ratio;
        }
      }
    }
  });
  std::erase_if(ratios, [](double ratio) { return std::isnan(ratio); });

  SizeChange change;
  change.triangles = static_cast<std::int64_t>(ratios.size());
  change.left_out = static_cast<std::int64_t>(count) - change.triangles;
  if (ratios.empty()) {
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = nan;
    return change;
  }
  change.rms_log_ratio = std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(ratios.size()));
  const auto p1 = percentile(ratios, 1);
  const auto p99 = percentile(ratios, 99);
  std::nth_element(ratios.begin(), p1, ratios.end());
  change.ratio_p1 = *p1;
  std::nth_element(p1, p99, ratios.end());
  change.ratio_p99 = *p99;
  return change;
}

}  // namespace trismooth

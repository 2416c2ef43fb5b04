#include "trismooth/quality/size_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Triangles are taken in blocks of this size whatever the number of threads, and the blocks' sums are added up in
/// their order: no rounding depends on scheduling.
constexpr std::size_t triangles_a_block = 1024;

/// Twice the areas of the block's triangles from `first` on, NaN where one is not valid. Gathered first, since only
/// short loops overlap the cache misses of a mesh in random order.
void doubled_valid_areas(const TriangleView& view, std::size_t first, std::span<double> areas) {
  std::array<std::array<Point2<double>, 3>, triangles_a_block> corners;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto [a, b, c] = canonical_corners(view, first + t);
    corners[t] = {view.points[static_cast<std::size_t>(a)], view.points[static_cast<std::size_t>(b)],
                  view.points[static_cast<std::size_t>(c)]};
  }
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto [a, b, c] = corners[t];
    areas[t] = shape_quotient(a, b, c) > 0 ? cross(b - a, c - a) : no_number;
  }
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
  std::vector<double> sums((count + triangles_a_block - 1) / triangles_a_block);
  Workers(threads).for_blocks(static_cast<std::int64_t>(sums.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    std::array<double, triangles_a_block> areas_before;
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
      const std::size_t first = block * triangles_a_block;
      const std::span<double> of_block = std::span(ratios).subspan(first, std::min(triangles_a_block, count - first));
      doubled_valid_areas(before, first, std::span(areas_before).first(of_block.size()));
      doubled_valid_areas(after, first, of_block);
      for (std::size_t t = 0; t < of_block.size(); ++t) {
        of_block[t] = of_block[t] / areas_before[t] * unit;
        if (!std::isnan(of_block[t])) {
          const double log_ratio = std::log(of_block[t]);
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
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = no_number;
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

#include "trismooth/quality/size_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

/// Sums over the triangles, which are taken in blocks of this size whatever the number of threads; the blocks' sums are
/// added up in their order, so no rounding depends on scheduling.
constexpr std::size_t fitted_triangles_a_block = 1024;

struct FitSums {
  double areas = 0;
  double areas_asked = 0;
  double squares = 0;
  std::int64_t triangles = 0;
  std::int64_t left_out = 0;
};

template <class Visit>
FitSums sum_of_blocks(std::size_t count, Workers& workers, const Visit& visit) {
  std::vector<FitSums> blocks((count + fitted_triangles_a_block - 1) / fitted_triangles_a_block);
  workers.for_blocks(std::ssize(blocks), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
      const std::size_t last = std::min(count, (block + 1) * fitted_triangles_a_block);
      for (std::size_t t = block * fitted_triangles_a_block; t < last; ++t) {
        visit(t, blocks[block]);
      }
    }
  });
  FitSums all;
  for (const FitSums& block : blocks) {
    all.areas += block.areas;
    all.areas_asked += block.areas_asked;
    all.squares += block.squares;
    all.triangles += block.triangles;
    all.left_out += block.left_out;
  }
  return all;
}

}  // namespace

SizeFit size_fit(const TriangleView& view, std::span<const double> inverse_areas, std::span<const std::uint8_t> held,
                 int threads) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Workers workers(threads);
  std::vector<double> ratios(view.triangles.size(), nan);  // NaN: not compared
  const FitSums sums = sum_of_blocks(ratios.size(), workers, [&](std::size_t t, FitSums& own) {
    const auto [a, b, c] = canonical_corners(view, t);
    if (held[a] != 0 && held[b] != 0 && held[c] != 0) {
      return;
    }
    if (!(shape_quotient(view.points[a], view.points[b], view.points[c]) > 0)) {
      ++own.left_out;
      return;
    }
    const double area = cross(view.points[b] - view.points[a], view.points[c] - view.points[a]);
    const double asked = 3 / (inverse_areas[a] + inverse_areas[b] + inverse_areas[c]);
    ratios[t] = area / asked;
    own.areas += area;
    own.areas_asked += asked;
    ++own.triangles;
  });
  const double log_unit = std::log(sums.areas / sums.areas_asked);
  const FitSums logs = sum_of_blocks(ratios.size(), workers, [&](std::size_t t, FitSums& own) {
    if (!std::isnan(ratios[t])) {
      const double log_ratio = std::log(ratios[t]) - log_unit;
      own.squares += log_ratio * log_ratio;
    }
  });
  return {sums.triangles, sums.left_out,
          sums.triangles > 0 ? std::sqrt(logs.squares / static_cast<double>(sums.triangles)) : nan};
}

}  // namespace trismooth

#include "trismooth/quality/size_change.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>
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

/// The ratios that are numbers, by their leading bits: they are not negative, so these stand in their order.
class RatioCounts {
 public:
  explicit RatioCounts(std::span<const double> ratios, Workers& workers) : ratios_(ratios), workers_(workers) {
    for_parts([&](std::span<const double> part) {
      std::vector<std::int64_t> counts(counts_.size());
      for (const double ratio : part) {
        if (!std::isnan(ratio)) {
          ++counts[bits_of(ratio)];
        }
      }
      const std::lock_guard lock(joining_);
      std::ranges::transform(counts_, counts, counts_.begin(), std::plus<>());
    });
    total_ = std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
  }

  std::int64_t total() const { return total_; }

  /// The smallest ratio that `percent` per cent do not exceed. There is one.
  double percentile(std::int64_t percent) {
    std::int64_t before = 0;  // ratios with smaller leading bits
    const std::int64_t rank = (total_ * percent + 99) / 100;
    std::size_t bits = 0;
    while (before + counts_[bits] < rank) {
      before += counts_[bits++];
    }
    std::vector<double> candidates;
    for_parts([&](std::span<const double> part) {
      std::vector<double> found;
      std::ranges::copy_if(part, std::back_inserter(found),
                           [&](double ratio) { return !std::isnan(ratio) && bits_of(ratio) == bits; });
      const std::lock_guard lock(joining_);
      candidates.insert(candidates.end(), found.begin(), found.end());
    });
    const auto place = candidates.begin() + static_cast<std::ptrdiff_t>(rank - before - 1);
    std::nth_element(candidates.begin(), place, candidates.end());
    return *place;
  }

 private:
  static constexpr std::int64_t grain = 65536;
  static constexpr int leading_bits = 16;  // sign, exponent and four more: 16 steps an octave

  static std::size_t bits_of(double ratio) { return std::bit_cast<std::uint64_t>(ratio) >> (64U - leading_bits); }

  template <class Body>
  void for_parts(const Body& body) {
    workers_.for_blocks(std::ssize(ratios_), grain, [&](std::int64_t begin, std::int64_t end) {
      body(ratios_.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
    });
  }

  std::span<const double> ratios_;
  Workers& workers_;
  std::mutex joining_;
  std::vector<std::int64_t> counts_ = std::vector<std::int64_t>(std::size_t{1} << leading_bits);
  std::int64_t total_ = 0;
};

}  // namespace

SizeChange size_change(const TriangleView& before, const TriangleView& after, int threads) {
  const std::size_t count = before.triangles.size();
  if (after.triangles.size() != count) {
    throw std::invalid_argument("size_change: the meshes have different triangles");
  }
  const double unit = std::ldexp(1.0, 2 * (after.exponent - before.exponent));
  std::vector<double> ratios(count);
  std::vector<double> sums((count + triangles_a_block - 1) / triangles_a_block);
  Workers workers(threads);
  workers.for_blocks(static_cast<std::int64_t>(sums.size()), 1, [&](std::int64_t begin, std::int64_t end) {
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
  RatioCounts counts(ratios, workers);
  SizeChange change;
  change.triangles = counts.total();
  change.left_out = static_cast<std::int64_t>(count) - change.triangles;
  if (change.triangles == 0) {
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = no_number;
    return change;
  }
  change.rms_log_ratio =
      std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(change.triangles));
  change.ratio_p1 = counts.percentile(1);
  change.ratio_p99 = counts.percentile(99);
  return change;
}

}  // namespace trismooth

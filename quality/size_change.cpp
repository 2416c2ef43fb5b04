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

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Triangles are taken in blocks of this size whatever the number of threads, and the blocks' sums are added up in
/// their order: no rounding depends on scheduling.
constexpr std::size_t triangles_a_block = 1024;

/// Twice the areas of the block's triangles from `first` on, NaN where one is not valid.
void doubled_valid_areas(const TriangleView& view, std::size_t first, std::span<double> areas) {
  for_corners(view, first, first + areas.size(), [&](std::size_t begin, std::span<const CornerPoints> corners) {
    std::ranges::transform(corners, areas.begin() + static_cast<std::ptrdiff_t>(begin - first), [](const auto& of) {
      const auto& [a, b, c] = of;
      return shape_quotient(a, b, c) > 0 ? cross(b - a, c - a) : no_number;
    });
  });
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

  /// The smallest ratios that `percents` per cent do not exceed. There is one.
  std::array<double, 2> percentiles(const std::array<std::int64_t, 2>& percents) {
    struct Wanted {
      std::int64_t rank;  ///< among the candidates
      std::size_t bits;   ///< of these
      std::vector<double> candidates;
    };
    std::array<Wanted, 2> wanted;
    std::ranges::transform(percents, wanted.begin(), [this](std::int64_t percent) {
      std::int64_t rank = (total_ * percent + 99) / 100;
      std::size_t bits = 0;
      while (counts_[bits] < rank) {
        rank -= counts_[bits++];
      }
      return Wanted{rank, bits, {}};
    });
    for_parts([&](std::span<const double> part) {
      std::array<std::vector<double>, 2> found;
      for (const double ratio : part) {
        const std::size_t bits = bits_of(ratio);
        if (bits == wanted[0].bits || bits == wanted[1].bits) {
          found[bits == wanted[0].bits ? 0 : 1].push_back(ratio);
        }
      }
      const std::lock_guard lock(joining_);
      for (std::size_t i = 0; i < found.size(); ++i) {
        wanted[i].candidates.insert(wanted[i].candidates.end(), found[i].begin(), found[i].end());
      }
    });
    if (wanted[0].bits == wanted[1].bits) {
      wanted[1].candidates = wanted[0].candidates;
    }
    std::array<double, 2> found;
    std::ranges::transform(wanted, found.begin(), [](Wanted& of) {
      const auto place = of.candidates.begin() + static_cast<std::ptrdiff_t>(of.rank - 1);
      std::nth_element(of.candidates.begin(), place, of.candidates.end());
      return *place;
    });
    return found;
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
  BulkVector<double> ratios(count);
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
  const auto [p1, p99] = counts.percentiles({1, 99});
  change.ratio_p1 = p1;
  change.ratio_p99 = p99;
  return change;
}

}  // namespace trismooth

#include "trismooth/quality/size_change.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/quality/area_ratios.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Twice the areas of the block's triangles from `first` on, NaN where one is not valid.
void doubled_valid_areas(const TriangleView& view, std::size_t first, std::span<double> areas) {
  for_corners(view, first, first + areas.size(), [&](std::size_t begin, std::span<const CornerPoints> corners) {
    std::ranges::transform(corners, areas.begin() + static_cast<std::ptrdiff_t>(begin - first), [](const auto& of) {
      const auto& [a, b, c] = of;
      return shape_quotient(a, b, c) > 0 ? cross(b - a, c - a) : no_number;
    });
  });
}

/// Finds ratios by their rank among those that are numbers. These are not negative, so their bits stand in their order:
/// they are counted by their first digits of 16 bits, those with the right ones by the next digit, and so on until few
/// are left.
class RatioRanks {
 public:
  explicit RatioRanks(std::span<const double> ratios, Workers& workers)
      : ratios_(ratios), workers_(workers), by_first_digit_(count_by_next_digit({0, 0})) {
    total_ = std::accumulate(by_first_digit_.begin(), by_first_digit_.end(), std::int64_t{0});
  }

  std::int64_t total() const { return total_; }

  /// The smallest ratio that `percent` per cent do not exceed. There is one.
  double percentile(std::int64_t percent) {
    std::int64_t rank = (total_ * percent + 99) / 100;
    Prefix prefix{0, 0};
    std::int64_t count = descend(by_first_digit_, rank, prefix);
    while (count > most_candidates && prefix.bits < 64) {
      count = descend(count_by_next_digit(prefix), rank, prefix);
    }
    if (prefix.bits == 64) {
      return std::bit_cast<double>(prefix.value);
    }
    std::vector<double> candidates = those_with(prefix);
    const auto place = candidates.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(candidates.begin(), place, candidates.end());
    return *place;
  }

 private:
  static constexpr std::int64_t grain = 65536;
  static constexpr int digit_bits = 16;  // of the first one: sign, exponent and 16 steps an octave
  static constexpr std::int64_t most_candidates = std::int64_t{1} << 17;

  /// The leading bits of a number.
  struct Prefix {
    std::uint64_t value;
    int bits;
  };

  /// Whether it is a number with that prefix.
  static bool is_of(Prefix prefix, double ratio) {
    return !std::isnan(ratio) &&
           (prefix.bits == 0 || std::bit_cast<std::uint64_t>(ratio) >> (64 - prefix.bits) == prefix.value);
  }

  /// How many ratios with that prefix have each next digit.
  std::vector<std::int64_t> count_by_next_digit(Prefix prefix) {
    const int shift = 64 - prefix.bits - digit_bits;
    return joined_blocks(
        std::ssize(ratios_), grain, workers_, std::vector<std::int64_t>(std::size_t{1} << digit_bits),
        [&](std::int64_t begin, std::int64_t end, std::vector<std::int64_t>& counts) {
          for (std::int64_t i = begin; i < end; ++i) {
            if (is_of(prefix, ratios_[i])) {
              ++counts[std::bit_cast<std::uint64_t>(ratios_[i]) >> shift & (counts.size() - 1)];
            }
          }
        },
        [](std::vector<std::int64_t>& all, const std::vector<std::int64_t>& counts) {
          std::ranges::transform(all, counts, all.begin(), std::plus<>());
        });
  }

  /// Appends to the prefix the digit of the ratio with that rank, which becomes the rank among those with this prefix.
  /// Returns how many these are.
  static std::int64_t descend(const std::vector<std::int64_t>& counts, std::int64_t& rank, Prefix& prefix) {
    std::size_t digit = 0;
    while (counts[digit] < rank) {
      rank -= counts[digit++];
    }
    prefix = {prefix.value << digit_bits | digit, prefix.bits + digit_bits};
    return counts[digit];
  }

  std::vector<double> those_with(Prefix prefix) {
    return joined_lists<double>(std::ssize(ratios_), grain, workers_, [&](std::int64_t i, std::vector<double>& found) {
      if (is_of(prefix, ratios_[i])) {
        found.push_back(ratios_[i]);
      }
    });
  }

  std::span<const double> ratios_;
  Workers& workers_;
  std::vector<std::int64_t> by_first_digit_;
  std::int64_t total_ = 0;
};

}  // namespace

AreaRatios area_ratios(const TriangleView& before, const TriangleView& after, int threads) {
  const std::size_t count = before.triangles.size();
  if (after.triangles.size() != count) {
    throw std::invalid_argument("size_change: the meshes have different triangles");
  }
  const double unit = std::ldexp(1.0, 2 * (after.exponent - before.exponent));
  BulkVector<double> ratios(count);
  std::vector<double> sums((count + triangles_a_size_part - 1) / triangles_a_size_part);
  Workers workers(threads);
  workers.for_blocks(static_cast<std::int64_t>(sums.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    std::array<double, triangles_a_size_part> areas_before;
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
      const std::size_t first = block * triangles_a_size_part;
      const std::span<double> of_block =
          std::span(ratios).subspan(first, std::min(triangles_a_size_part, count - first));
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
  return {std::move(ratios), std::move(sums)};
}

SizeChange size_change(const TriangleView& before, const TriangleView& after, int threads) {
  const auto [ratios, sums] = area_ratios(before, after, threads);
  Workers workers(threads);
  RatioRanks ranks(ratios, workers);
  SizeChange change;
  change.triangles = ranks.total();
  change.left_out = std::ssize(ratios) - change.triangles;
  if (change.triangles == 0) {
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = no_number;
    return change;
  }
  change.rms_log_ratio =
      std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(change.triangles));
  change.ratio_p1 = ranks.percentile(1);
  change.ratio_p99 = ranks.percentile(99);
  return change;
}

}  // namespace trismooth

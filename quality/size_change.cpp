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

namespace trismooth {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Twice the areas of the block's triangles from `first` on, NaN where one is not valid.
void doubled_valid_areas(const TriangleView& view, std::size_t first, std::span<double> areas) {
  for_corners(view, first, first + areas.size(), [&](std::size_t begin, std::span<const CornerPoints> corners) {
    std::ranges::transform(corners, areas.begin() + static_cast<std::ptrdiff_t>(begin - first),
                           [](const auto& of) { return shape_quotient(of) > 0 ? doubled_area(of) : no_number; });
  });
}

/// Finds ratios by their rank among those that are numbers. These are not negative, so their bits stand in their order:
/// they are counted by their first digits of 16 bits, those with the right ones by the next digit, and so on.
class RatioRanks {
 public:
  RatioRanks(std::span<const double> ratios, const AddUpCounts& add_up, Workers& workers)
      : ratios_(ratios), add_up_(add_up), workers_(workers), by_first_digit_(count_by_next_digit({0, 0})) {
    total_ = std::accumulate(by_first_digit_.begin(), by_first_digit_.end(), std::int64_t{0});
  }

  std::int64_t total() const { return total_; }

  /// The smallest ratio that `percent` per cent do not exceed. There is one.
  double percentile(std::int64_t percent) const {
    std::int64_t rank = (total_ * percent + 99) / 100;
    Prefix prefix{0, 0};
    descend(by_first_digit_, rank, prefix);
    while (prefix.bits < 64) {
      descend(count_by_next_digit(prefix), rank, prefix);
    }
    return std::bit_cast<double>(prefix.value);
  }

 private:
  static constexpr std::int64_t grain = 65536;
  static constexpr int digit_bits = 16;  // of the first one: sign, exponent and 16 steps an octave

  /// The leading bits of a number.
  struct Prefix {
    std::uint64_t value;
    int bits;
  };

  /// How many ratios with that prefix have each next digit.
  std::vector<std::int64_t> count_by_next_digit(Prefix prefix) const {
    const int shift = 64 - prefix.bits - digit_bits;
    std::vector<std::int64_t> counts = joined_blocks(
        std::ssize(ratios_), grain, workers_, std::vector<std::int64_t>(std::size_t{1} << digit_bits),
        [&](std::int64_t begin, std::int64_t end, std::vector<std::int64_t>& of_block) {
          for (std::int64_t i = begin; i < end; ++i) {
            const auto bits = std::bit_cast<std::uint64_t>(ratios_[i]);
            if (!std::isnan(ratios_[i]) && (prefix.bits == 0 || bits >> (64 - prefix.bits) == prefix.value)) {
              ++of_block[bits >> shift & (of_block.size() - 1)];
            }
          }
        },
        [](std::vector<std::int64_t>& all, const std::vector<std::int64_t>& of_block) {
          std::ranges::transform(all, of_block, all.begin(), std::plus<>());
        });
    add_up_(counts);
    return counts;
  }

  /// Appends to the prefix the digit of the ratio with that rank, which becomes the rank among those with this prefix.
  static void descend(const std::vector<std::int64_t>& counts, std::int64_t& rank, Prefix& prefix) {
    std::size_t digit = 0;
    while (counts[digit] < rank) {
      rank -= counts[digit++];
    }
    prefix = {prefix.value << digit_bits | digit, prefix.bits + digit_bits};
  }

  std::span<const double> ratios_;
  const AddUpCounts& add_up_;
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

SizeChange size_change_of(std::span<const double> ratios, double sum, const AddUpCounts& add_up, int threads) {
  Workers workers(threads);
  const RatioRanks ranks(ratios, add_up, workers);
  std::vector<std::int64_t> count{std::ssize(ratios)};
  add_up(count);
  SizeChange change;
  change.triangles = ranks.total();
  change.left_out = count.front() - change.triangles;
  if (change.triangles == 0) {
    change.rms_log_ratio = change.ratio_p1 = change.ratio_p99 = no_number;
    return change;
  }
  change.rms_log_ratio = std::sqrt(sum / static_cast<double>(change.triangles));
  change.ratio_p1 = ranks.percentile(1);
  change.ratio_p99 = ranks.percentile(99);
  return change;
}

SizeChange size_change(const TriangleView& before, const TriangleView& after, int threads) {
  const auto [ratios, sums] = area_ratios(before, after, threads);
  const auto is_all = [](std::vector<std::int64_t>& /*counts*/) {};
  return size_change_of(ratios, std::accumulate(sums.begin(), sums.end(), 0.0), is_all, threads);
}

}  // namespace trismooth

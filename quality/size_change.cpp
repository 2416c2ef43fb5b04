// SPDX-License-Identifier: BSD-3-Clause
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

constexpr auto doubled_valid_area = [](const auto& corners) {
  return shape_quotient(corners) > 0 ? doubled_area(corners) : no_number;
};

/// Twice the areas of the block's elements from `first` on, NaN where one is not valid.
void doubled_valid_areas(const TriangleView& view, std::size_t first, std::span<double> areas) {
  for_corners(view, first, first + areas.size(), [&](std::size_t begin, std::span<const CornerPoints> corners) {
    std::ranges::transform(corners, areas.begin() + static_cast<std::ptrdiff_t>(begin - first), doubled_valid_area);
  });
}
void doubled_valid_areas(const ElementView<MixedElement>& view, std::size_t first, std::span<double> areas) {
  for (std::size_t i = 0; i < areas.size(); ++i) {
    areas[i] = with_points(view, first + i, doubled_valid_area);
  }
}
void doubled_valid_areas(const MeshView& mesh, std::size_t first, std::span<double> areas) {
  mesh.visit([&](const auto& view) { doubled_valid_areas(view, first, areas); });
}

/// Finds ratios by their rank among those that are numbers. These are not negative, so their bits stand in their order:
/// they are counted by their first digits of 13 bits, those with the right ones by the next digit, and so on.
class RatioRanks {
 public:
  RatioRanks(std::span<const double> ratios, const AddUpCounts& add_up, Workers& workers)
      : ratios_(ratios), add_up_(add_up), workers_(workers), by_first_digit_(count_next_digits({0, 0}, 0)) {
    total_ = std::accumulate(by_first_digit_[0].begin(), by_first_digit_[0].end(), std::int64_t{0});
  }

  std::int64_t total() const { return total_; }

  /// The smallest ratios that so many per cent do not exceed. There are such.
  std::array<double, 2> percentiles(const std::array<std::int64_t, 2>& percents) const {
    std::array<std::int64_t, 2> ranks{};
    std::ranges::transform(percents, ranks.begin(), [this](std::int64_t p) { return (total_ * p + 99) / 100; });
    Prefixes found{};
    int known = 0;
    while (known < 64) {
      const Counts counts = known == 0 ? by_first_digit_ : count_next_digits(found, known);
      for (std::size_t i = 0; i < found.size(); ++i) {
        std::size_t digit = 0;
        while (counts[i][digit] < ranks[i]) {
          ranks[i] -= counts[i][digit++];
        }
        found[i] = found[i] << bits_behind(known) | digit;
      }
      known += bits_behind(known);
    }
    return {std::bit_cast<double>(found[0]), std::bit_cast<double>(found[1])};
  }

 private:
  /// The leading bits of the ratios that are looked for, and how many ratios that begin with them have each next digit.
  using Prefixes = std::array<std::uint64_t, 2>;
  using Counts = std::array<std::vector<std::int64_t>, 2>;

  static constexpr std::int64_t grain = 65536;

  /// Of the digit behind so many known bits. (The first one has the sign, the exponent and two steps an octave.)
  static int bits_behind(int known) { return std::min(13, 64 - known); }

  Counts count_next_digits(const Prefixes& prefixes, int known) const {
    const int bits = bits_behind(known);
    const std::vector<std::int64_t> none(std::size_t{1} << bits);
    const bool is_one = prefixes[0] == prefixes[1];
    Counts counts = joined_blocks(
        std::ssize(ratios_), grain, workers_, Counts{none, is_one ? std::vector<std::int64_t>() : none},
        [&](std::int64_t begin, std::int64_t end, Counts& of_block) {
          for (std::int64_t i = begin; i < end; ++i) {
            const auto ratio = std::bit_cast<std::uint64_t>(ratios_[i]);
            const std::uint64_t prefix = known == 0 ? 0 : ratio >> (64 - known);
            const std::size_t digit = ratio >> (64 - known - bits) & (none.size() - 1);
            if (prefix == prefixes[0] && !std::isnan(ratios_[i])) {
              ++of_block[0][digit];
            } else if (prefix == prefixes[1] && !std::isnan(ratios_[i])) {
              ++of_block[1][digit];
            }
          }
        },
        [](Counts& all, const Counts& of_block) {
          for (std::size_t i = 0; i < all.size(); ++i) {
            std::ranges::transform(all[i], of_block[i], all[i].begin(), std::plus<>());
          }
        });
    add_up_(counts[0]);
    if (is_one) {
      counts[1] = counts[0];
    } else {
      add_up_(counts[1]);
    }
    return counts;
  }

  std::span<const double> ratios_;
  const AddUpCounts& add_up_;
  Workers& workers_;
  Counts by_first_digit_;
  std::int64_t total_ = 0;
};

}  // namespace

AreaRatios area_ratios(const MeshView& before, const MeshView& after, int threads) {
  const std::size_t count = before.elements.size();
  if (after.elements.size() != count) {
    throw std::invalid_argument("size_change: the meshes have different elements");
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
  const auto [first, last] = ranks.percentiles({1, 99});
  change.ratio_p1 = first;
  change.ratio_p99 = last;
  return change;
}

SizeChange size_change(const MeshView& before, const MeshView& after, int threads) {
  const auto [ratios, sums] = area_ratios(before, after, threads);
  const auto is_all = [](std::vector<std::int64_t>& /*counts*/) {};
  return size_change_of(ratios, std::accumulate(sums.begin(), sums.end(), 0.0), is_all, threads);
}

}  // namespace trismooth

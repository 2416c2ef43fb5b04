// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/partition/bisection.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include <mpi.h>

namespace trismooth {

namespace {

/// A number that stands in the order of coordinates, -0 as 0.
std::uint64_t in_order(double coordinate) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(coordinate + 0.0);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// Parts that have not been told apart yet.
struct Group {
  int first;
  int count;
};

/// Cuts the points of all groups, each of more than one part in two.
class Level {
 public:
  Level(std::span<const Point2<double>> points, const std::vector<Group>& groups, BisectionSlack slack,
        std::vector<std::int32_t>& group_of, const mpi::Communicator& ranks)
      : points_(points), groups_(groups), slack_(slack), group_of_(group_of), ranks_(ranks) {}

  std::vector<Group> cut() {
    find_sides();
    find_cuts();
    std::vector<Group> halves;
    for (const Group& group : groups_) {
      const int lower = group.count / 2;
      halves.push_back({group.first, group.count - lower});
      halves.push_back({group.first + group.count - lower, lower});
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const auto g = static_cast<std::size_t>(group_of_[p]);
      const bool is_beyond = groups_[g].count > 1 && key(p, g) > cuts_[g];
      group_of_[p] = static_cast<std::int32_t>(2 * g + (is_beyond ? 1 : 0));
    }
    return halves;
  }

 private:
  std::uint64_t key(std::size_t point, std::size_t group) const {
    return in_order(along_y_[group] != 0 ? points_[point].y : points_[point].x);
  }

  /// Across which side each group is cut.
  void find_sides() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> ends(4 * groups_.size(), -infinity);  // of each group: x, -x, y, -y
    for (std::size_t p = 0; p < points_.size(); ++p) {
      double* const end = ends.data() + 4 * static_cast<std::size_t>(group_of_[p]);
      const auto& [x, y] = points_[p];
      end[0] = std::max(end[0], x);
      end[1] = std::max(end[1], -x);
      end[2] = std::max(end[2], y);
      end[3] = std::max(end[3], -y);
    }
    MPI_Allreduce(MPI_IN_PLACE, ends.data(), static_cast<int>(ends.size()), MPI_DOUBLE, MPI_MAX, ranks_.handle());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      // Halves, so that no extent overflows.
      const double x = ends[4 * g] / 2 + ends[4 * g + 1] / 2;
      const double y = ends[4 * g + 2] / 2 + ends[4 * g + 3] / 2;
      along_y_.push_back(y > x ? 1 : 0);
      const std::size_t side = 4 * g + (y > x ? 2 : 0);
      // Above the bits in which the ends differ all keys of the group are the same.
      const std::uint64_t last = in_order(ends[side]);
      const int differing = 64 - std::countl_zero(last ^ in_order(-ends[side + 1]));
      const bool is_cut = groups_[g].count > 1 && ends[side] >= -ends[side + 1];
      bits_.push_back(is_cut ? differing : 0);
      cuts_.push_back(differing == 64 ? all_bits : last | ((std::uint64_t{1} << static_cast<unsigned>(differing)) - 1));
    }
  }

  /// The number of each group's points that are not beyond its cut.
  std::vector<std::int64_t> count_within(const std::vector<std::uint64_t>& cuts) const {
    std::vector<std::int64_t> counts(groups_.size(), 0);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const auto g = static_cast<std::size_t>(group_of_[p]);
      counts[g] += key(p, g) <= cuts[g] ? 1 : 0;
    }
    ranks_.sum(counts);
    return counts;
  }

  /// The lowest cuts that leave the first halves of the groups enough points, but for the slack: bit by bit.
  void find_cuts() {
    std::vector<std::int64_t> within = count_within(cuts_);
    std::vector<std::int64_t> wanted = within;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const int count = std::max(groups_[g].count, 1);
      const int lower = count - count / 2;
      wanted[g] = wanted[g] / count * lower + wanted[g] % count * lower / count;
    }
    for (int bit = std::ranges::max(bits_) - 1; bit >= 0; --bit) {
      std::vector<std::uint64_t> lower = cuts_;
      bool is_any_open = false;
      for (std::size_t g = 0; g < lower.size(); ++g) {
        const double slack = groups_[g].count <= slack_.most_parts ? slack_.part : 0;
        const auto most = wanted[g] + static_cast<std::int64_t>(slack * static_cast<double>(wanted[g]));
        if (bit < bits_[g] && within[g] > most) {
          lower[g] ^= std::uint64_t{1} << static_cast<unsigned>(bit);
          is_any_open = true;
        }
        is_any_open = is_any_open || (bits_[g] > 0 && bit >= bits_[g]);
      }
      if (!is_any_open) {
        break;
      }
      const std::vector<std::int64_t> counts = count_within(lower);
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        if (counts[g] >= wanted[g]) {
          cuts_[g] = lower[g];
          within[g] = counts[g];
        }
      }
    }
  }

  static constexpr std::uint64_t all_bits = std::numeric_limits<std::uint64_t>::max();

  std::span<const Point2<double>> points_;
  const std::vector<Group>& groups_;
  BisectionSlack slack_;
  std::vector<std::int32_t>& group_of_;
  const mpi::Communicator& ranks_;
  std::vector<std::uint8_t> along_y_;
  std::vector<int> bits_;  ///< of each group: the low bits of keys in which its cut is to be found
  std::vector<std::uint64_t> cuts_;
};

}  // namespace

std::vector<std::int32_t> bisected(std::span<const Point2<double>> points, int parts, const mpi::Communicator& ranks,
                                   BisectionSlack slack) {
  std::vector<Group> groups{{0, parts}};
  std::vector<std::int32_t> group_of(points.size(), 0);
  while (std::ranges::any_of(groups, [](const Group& group) { return group.count > 1; })) {
    groups = Level(points, groups, slack, group_of, ranks).cut();
  }
  std::ranges::transform(group_of, group_of.begin(),
                         [&](std::int32_t group) { return groups[static_cast<std::size_t>(group)].first; });
  return group_of;
}

}  // namespace trismooth

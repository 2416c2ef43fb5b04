// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/middle_nodes.h"

#include <algorithm>
#include <cmath>

#include "trismooth/base/machine/call_limit.h"

namespace trismooth {

namespace {

using SideEnds = std::array<std::int32_t, 2>;

/// Calls visit(middle, ends) for the sides of all quadratic triangles.
template <class Visit>
void for_each_quadratic_side(const ElementList& elements, std::span<const QuadraticTriangle> quadratics,
                             const Visit& visit) {
  for (std::size_t q = 0; q < quadratics.size(); ++q) {
    if (q % 16384 == 0) {
      CallLimit::look();
    }
    const QuadraticTriangle& element = quadratics[q];
    const auto corners = elements[static_cast<std::size_t>(element.triangle)];
    for (std::size_t side = 0; side < 3; ++side) {
      const auto [low, high] = std::minmax({corners[side], next_corner(corners, side)});
      visit(static_cast<std::size_t>(element.middles[side]), SideEnds{low, high});
    }
  }
}

}  // namespace

double share_of_side(const std::array<double, 3>& first, const std::array<double, 3>& middle,
                     const std::array<double, 3>& second) {
  constexpr double nearest_to_end = 1.0 / 16;
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size = std::max({size, std::abs(first[axis]), std::abs(middle[axis]), std::abs(second[axis])});
  }
  if (size == 0) {
    return 0.5;
  }
  // A power of two, so that the share is that of a mesh of any scale. Halves of it do not overflow.
  const int scale = std::ilogb(size) + 1;
  std::array<double, 3> side{};
  std::array<double, 3> part{};
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from = std::scalbn(first[axis], -scale);
    side[axis] = std::scalbn(second[axis], -scale) - from;
    part[axis] = std::scalbn(middle[axis], -scale) - from;
    longest = std::max(longest, std::abs(side[axis]));
  }
  if (longest == 0) {
    return 0.5;
  }
  double along = 0;
  double length = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double unit = side[axis] / longest;
    along += unit * (part[axis] / longest);
    length += unit * unit;
  }
  const double share = along / length;
  // Not a number, or infinite, where the side is far shorter than its middle is away.
  return std::isfinite(share) ? std::clamp(share, nearest_to_end, 1 - nearest_to_end) : 0.5;
}

std::vector<MiddleNode> settle_middles(const ElementList& elements, std::span<const QuadraticTriangle> quadratics,
                                       std::vector<std::uint8_t>& named, std::vector<std::uint8_t>& in_other_cell) {
  std::vector<MiddleNode> following;
  if (quadratics.empty()) {
    return following;
  }
  enum : std::uint8_t { unknown, follows, stays };
  constexpr SideEnds no_side{-1, -1};
  std::vector<std::uint8_t> fates(in_other_cell.size(), unknown);
  std::vector<SideEnds> sides(in_other_cell.size(), no_side);
  for (const auto corners : elements) {
    for (const std::int32_t corner : corners) {
      fates[static_cast<std::size_t>(corner)] = stays;
    }
  }
  for_each_quadratic_side(elements, quadratics, [&](std::size_t middle, const SideEnds& ends) {
    const bool has_other_side = sides[middle] != no_side && sides[middle] != ends;
    const bool is_held = in_other_cell[middle] != 0 || (!named.empty() && named[middle] != 0);
    if (fates[middle] == unknown) {
      fates[middle] = is_held ? stays : follows;
    } else if (has_other_side) {
      fates[middle] = stays;
    }
    sides[middle] = ends;
  });
  for_each_quadratic_side(elements, quadratics, [&](std::size_t middle, const SideEnds& ends) {
    if (fates[middle] == stays) {
      in_other_cell[middle] = 1;
      std::vector<std::uint8_t>& holding = !named.empty() && named[middle] != 0 ? named : in_other_cell;
      for (const std::int32_t end : ends) {
        holding[static_cast<std::size_t>(end)] = 1;
      }
    } else if (fates[middle] == follows) {
      fates[middle] = unknown;  // listed
      in_other_cell[middle] = 1;
      following.push_back({static_cast<std::int32_t>(middle), ends});
    }
  });
  return following;
}

MiddlesOfEnds::MiddlesOfEnds(std::size_t vertex_count, std::span<const MiddleNode> middles) {
  if (middles.empty()) {
    return;
  }
  starts_.resize(vertex_count + 1, 0);
  for (const MiddleNode& middle : middles) {
    for (const std::int32_t end : middle.ends) {
      ++starts_[static_cast<std::size_t>(end) + 1];
    }
  }
  for (std::size_t v = 1; v < starts_.size(); ++v) {
    starts_[v] += starts_[v - 1];
  }
  around_.resize(static_cast<std::size_t>(starts_.back()));
  std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t m = 0; m < middles.size(); ++m) {
    for (const std::int32_t end : middles[m].ends) {
      around_[static_cast<std::size_t>(next[static_cast<std::size_t>(end)]++)] = static_cast<std::int32_t>(m);
    }
  }
}

std::span<const std::int32_t> MiddlesOfEnds::operator[](std::int32_t vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return starts_.empty() ? std::span<const std::int32_t>{}
                         : std::span(around_).subspan(static_cast<std::size_t>(starts_[v]),
                                                      static_cast<std::size_t>(starts_[v + 1] - starts_[v]));
}

}  // namespace trismooth

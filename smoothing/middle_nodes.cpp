// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/middle_nodes.h"

#include <algorithm>
#include <cmath>

#include "trismooth/base/machine/call_limit.h"

namespace trismooth {

namespace {

using Place = std::array<double, 3>;
using Followed = std::array<std::int32_t, 4>;  // as MiddleNode::corners

/// Calls visit(middle, followed) for the sides of all quadratic elements, and for their centres.
template <class Visit>
void for_each_middle(const ElementList& elements, std::span<const QuadraticElement> quadratics, const Visit& visit) {
  for (std::size_t q = 0; q < quadratics.size(); ++q) {
    if (q % 16384 == 0) {
      CallLimit::look();
    }
    const QuadraticElement& element = quadratics[q];
    const auto corners = elements[static_cast<std::size_t>(element.element)];
    for (std::size_t side = 0; side < corners.size(); ++side) {
      const auto [low, high] = std::minmax({corners[side], next_corner(corners, side)});
      visit(static_cast<std::size_t>(element.middles[side]), Followed{low, high, no_corner, no_corner});
    }
    if (corners.size() == 4 && element.centre() != no_corner) {
      visit(static_cast<std::size_t>(element.centre()), Followed{corners[0], corners[1], corners[2], corners[3]});
    }
  }
}

double largest_number(std::span<const Place> places) {
  double size = 0;
  for (const Place& place : places) {
    for (const double number : place) {
      size = std::max(size, std::abs(number));
    }
  }
  return size;
}

/// By a power of two, so that shares are those of a mesh of any scale, and sums of some places do not overflow.
template <std::size_t count>
std::array<Place, count> scaled(std::array<Place, count> places) {
  const double size = largest_number(places);
  const int scale = size > 0 ? std::ilogb(size) + 1 : 0;
  for (Place& place : places) {
    for (double& number : place) {
      number = std::scalbn(number, -scale);
    }
  }
  return places;
}

Place difference(const Place& a, const Place& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double product(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A share, kept away from the ends; the middle for what is not finite, where a side is far too short.
double within_side(double share) {
  constexpr double nearest_to_end = 1.0 / 16;
  return std::isfinite(share) ? std::clamp(share, nearest_to_end, 1 - nearest_to_end) : 0.5;
}

}  // namespace

double share_of_side(const Place& first, const Place& middle, const Place& second) {
  const auto [from, at, to] = scaled(std::array{first, middle, second});
  const Place side = difference(to, from);
  const double longest = largest_number({&side, 1});
  if (longest == 0) {
    return 0.5;
  }
  const Place part = difference(at, from);
  double along = 0;
  double length = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double unit = side[axis] / longest;
    along += unit * (part[axis] / longest);
    length += unit * unit;
  }
  return within_side(along / length);
}

std::array<double, 2> shares_of_centre(const std::array<Place, 4>& corners, const Place& centre) {
  const auto [a, b, c, d, at] = scaled(std::array{corners[0], corners[1], corners[2], corners[3], centre});
  // Twice the ways, and four times the centre from the middle of the corners.
  Place along{};
  Place across{};
  Place off{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along[axis] = (b[axis] - a[axis]) + (c[axis] - d[axis]);
    across[axis] = (d[axis] - a[axis]) + (c[axis] - b[axis]);
    off[axis] = (at[axis] - a[axis]) + (at[axis] - b[axis]) + (at[axis] - c[axis]) + (at[axis] - d[axis]);
  }
  const double squares = product(along, along);
  const double other_squares = product(across, across);
  const double both = product(along, across);
  const double determinant = squares * other_squares - both * both;
  const double first = product(off, along);
  const double second = product(off, across);
  return {within_side(0.5 + 0.5 * ((first * other_squares - second * both) / determinant)),
          within_side(0.5 + 0.5 * ((second * squares - first * both) / determinant))};
}

SettledMiddles settle_middles(const ElementList& elements, std::span<const QuadraticElement> quadratics,
                              std::vector<std::uint8_t>& named, std::vector<std::uint8_t>& in_other_cell) {
  SettledMiddles settled;
  if (quadratics.empty()) {
    return settled;
  }
  enum : std::uint8_t { unknown, follows, stays, is_shared };
  constexpr Followed none{no_corner, no_corner, no_corner, no_corner};
  std::vector<std::uint8_t> fates(in_other_cell.size(), unknown);
  std::vector<Followed> sides(in_other_cell.size(), none);
  for (const auto corners : elements) {
    for (const std::int32_t corner : corners) {
      fates[static_cast<std::size_t>(corner)] = is_shared;
    }
  }
  for_each_middle(elements, quadratics, [&](std::size_t middle, const Followed& followed) {
    const bool has_other_side = sides[middle] != none && sides[middle] != followed;
    const bool is_held = in_other_cell[middle] != 0 || (!named.empty() && named[middle] != 0);
    if (fates[middle] == unknown) {
      fates[middle] = is_held ? stays : follows;
    } else if (has_other_side) {
      fates[middle] = is_shared;
    }
    sides[middle] = followed;
  });
  for_each_middle(elements, quadratics, [&](std::size_t middle, const Followed& followed) {
    if (fates[middle] == stays || fates[middle] == is_shared) {
      in_other_cell[middle] = 1;
      std::vector<std::uint8_t>& holding = !named.empty() && named[middle] != 0 ? named : in_other_cell;
      const MiddleNode held{.corners = followed};
      for (const std::int32_t corner : held.followed()) {
        holding[static_cast<std::size_t>(corner)] = 1;
      }
    } else if (fates[middle] == follows) {
      fates[middle] = unknown;  // listed
      in_other_cell[middle] = 1;
      settled.following.push_back({static_cast<std::int32_t>(middle), followed});
    }
  });
  // (`sides` has what is a middle.)
  for (std::size_t v = 0; v < fates.size(); ++v) {
    settled.shared += fates[v] == is_shared && sides[v] != none ? 1 : 0;
  }
  return settled;
}

MiddlesOfCorners::MiddlesOfCorners(std::size_t vertex_count, std::span<const MiddleNode> middles) {
  if (middles.empty()) {
    return;
  }
  starts_.resize(vertex_count + 1, 0);
  for (const MiddleNode& middle : middles) {
    for (const std::int32_t corner : middle.followed()) {
      ++starts_[static_cast<std::size_t>(corner) + 1];
    }
  }
  for (std::size_t v = 1; v < starts_.size(); ++v) {
    starts_[v] += starts_[v - 1];
  }
  around_.resize(static_cast<std::size_t>(starts_.back()));
  std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t m = 0; m < middles.size(); ++m) {
    for (const std::int32_t corner : middles[m].followed()) {
      around_[static_cast<std::size_t>(next[static_cast<std::size_t>(corner)]++)] = static_cast<std::int32_t>(m);
    }
  }
}

std::span<const std::int32_t> MiddlesOfCorners::operator[](std::int32_t vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return starts_.empty() ? std::span<const std::int32_t>{}
                         : std::span(around_).subspan(static_cast<std::size_t>(starts_[v]),
                                                      static_cast<std::size_t>(starts_[v + 1] - starts_[v]));
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/quadratic_quality.h"

namespace trismooth {

/// A node of quadratic elements that follows corners: in the middle of a side, or in the centre of a quadrilateral.
/// That of a side moves, at the fraction s of the side from its first end to its second, by 1 - s times what the first
/// end moves and s times what the second does; a centre as the place at the fraction t between those at s of two
/// opposite sides does.
struct MiddleNode {
  std::int32_t vertex = 0;
  /// The ends of its side, then no_corner twice; or the corners of its quadrilateral, in turn.
  std::array<std::int32_t, 4> corners{no_corner, no_corner, no_corner, no_corner};
  /// s, in (0, 1), from corner 0 to corner 1 (and from 3 to 2), and t from the side 01 to the side 32.
  std::array<double, 2> shares{0.5, 0.5};

  [[nodiscard]] bool is_centre() const { return corners[2] != no_corner; }
  /// Those that it follows: two, or four.
  [[nodiscard]] std::span<const std::int32_t> followed() const { return std::span(corners).first(is_centre() ? 4 : 2); }
};

/// The fraction of the side from its first end to its second at which its middle lies in the input: that of the nearest
/// place on the straight line through the ends. A middle that lies beyond an end, or nearly at it, gets 1/16 or 15/16:
/// it goes with that end, and the other has a say. 1/2 where the ends coincide. For straight sides the middle stays at
/// this fraction of the side; curved ones keep how far the middle is off the line, and in which direction. Coordinates
/// of any unit, x, y and z; no size of them overflows.
double share_of_side(const std::array<double, 3>& first, const std::array<double, 3>& middle,
                     const std::array<double, 3>& second);

/// By how much a middle with that share moves along an axis on which the ends of its side were and are there.
constexpr double middle_move(double share, double first_before, double first_now, double second_before,
                             double second_now) {
  return (1 - share) * (first_now - first_before) + share * (second_now - second_before);
}

/// The middles of quadratic elements, sorted by what becomes of them.
struct SettledMiddles {
  std::vector<MiddleNode> following;  ///< those that follow their corners
  std::int64_t shared = 0;  ///< those that stay since they are corners as well, or of several sides or centres
};

/// The middles of quadratic elements that follow their corners. Holds where that cannot be: a middle of two different
/// sides, one that is a corner as well, of any other cell, or that `named` holds (a byte a vertex, or empty: none is)
/// has to stay, and so have the ends of its sides, or the corners around a centre: in `named`, where it is named, else
/// in `in_other_cell` (a byte a vertex). That has all middles afterwards. Their shares are 1/2 until find_shares()
/// finds them. Complexity: linear.
SettledMiddles settle_middles(const ElementList& elements, std::span<const QuadraticElement> quadratics,
                              std::vector<std::uint8_t>& named, std::vector<std::uint8_t>& in_other_cell);

/// The fractions at which a centre lies in a quadrilateral of these corners, in turn: of the way from the middle of the
/// side 30 to that of 12, and from 01 to 32, in the plane of these ways. Between 1/16 and 15/16, and 1/2 where the
/// ways have one direction. Coordinates of any unit, x, y and z; no size of them overflows.
std::array<double, 2> shares_of_centre(const std::array<std::array<double, 3>, 4>& corners,
                                       const std::array<double, 3>& centre);

/// Gives the middles their shares. at(vertex): where it is in the input, as std::array<double, 3>. Complexity: linear.
template <class At>
void find_shares(std::span<MiddleNode> middles, const At& at) {
  for (MiddleNode& middle : middles) {
    const auto& [a, b, c, d] = middle.corners;
    if (middle.is_centre()) {
      middle.shares = shares_of_centre({at(a), at(b), at(c), at(d)}, at(middle.vertex));
    } else {
      middle.shares[0] = share_of_side(at(a), at(middle.vertex), at(b));
    }
  }
}

/// By how much a middle moves along an axis. `before`, `now`: called with a corner, where it was and is along the axis.
template <class Before, class Now>
double move_of(const MiddleNode& middle, const Before& before, const Now& now) {
  const auto along = [&](std::size_t first, std::size_t second) {
    const std::int32_t a = middle.corners[first];
    const std::int32_t b = middle.corners[second];
    return middle_move(middle.shares[0], before(a), now(a), before(b), now(b));
  };
  return middle.is_centre() ? middle_move(middle.shares[1], 0, along(0, 1), 0, along(3, 2)) : along(0, 1);
}

/// The middles that follow each vertex.
class MiddlesOfCorners {
 public:
  MiddlesOfCorners(std::size_t vertex_count, std::span<const MiddleNode> middles);

  /// Places among the middles.
  std::span<const std::int32_t> operator[](std::int32_t vertex) const;

 private:
  std::vector<std::int64_t> starts_;  ///< vertex v has around_[starts_[v] .. starts_[v + 1]); empty: none has any
  std::vector<std::int32_t> around_;
};

}  // namespace trismooth

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

/// A node in the middle of a side of quadratic triangles: at the fraction s of the side from its first end to its
/// second it moves by 1 - s times what the first end moves and s times what the second does.
struct MiddleNode {
  std::int32_t vertex = 0;
  std::array<std::int32_t, 2> ends{};
  double share = 0.5;  ///< s, in (0, 1): see share_of_side()
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

/// The middles of quadratic triangles that follow their sides. Holds where that cannot be: a middle of two different
/// sides, one that is a corner as well, of any other cell, or that `named` holds (a byte a vertex, or empty: none is)
/// has to stay, and so have the ends of its sides: in `named`, where it is named, else in `in_other_cell` (a byte a
/// vertex). That has all middles afterwards. Their shares are 1/2 until find_shares() finds them. Complexity: linear.
std::vector<MiddleNode> settle_middles(const ElementList& elements, std::span<const QuadraticTriangle> quadratics,
                                       std::vector<std::uint8_t>& named, std::vector<std::uint8_t>& in_other_cell);

/// Gives the middles their shares. at(vertex): where it is in the input, as std::array<double, 3>. Complexity: linear.
template <class At>
void find_shares(std::span<MiddleNode> middles, const At& at) {
  for (MiddleNode& middle : middles) {
    middle.share = share_of_side(at(middle.ends[0]), at(middle.vertex), at(middle.ends[1]));
  }
}

/// The middles that follow the sides which a vertex is an end of.
class MiddlesOfEnds {
 public:
  MiddlesOfEnds(std::size_t vertex_count, std::span<const MiddleNode> middles);

  /// Places among the middles.
  std::span<const std::int32_t> operator[](std::int32_t vertex) const;

 private:
  std::vector<std::int64_t> starts_;  ///< vertex v has around_[starts_[v] .. starts_[v + 1]); empty: none has any
  std::vector<std::int32_t> around_;
};

}  // namespace trismooth

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/quadratic_quality.h"

namespace trismooth {

/// A node in the middle of a side of quadratic triangles: it moves by the mean of what the side's ends move.
struct MiddleNode {
  std::int32_t vertex = 0;
  std::array<std::int32_t, 2> ends{};
};

/// By how much a middle moves along an axis on which the ends of its side were and are there.
constexpr double middle_move(double first_before, double first_now, double second_before, double second_now) {
  return (first_now - first_before) / 2 + (second_now - second_before) / 2;
}

/// The middles of quadratic triangles that follow their sides. Holds where that cannot be: a middle of two different
/// sides, one that is a corner as well, of any other cell, or that `named` holds (a byte a vertex, or empty: none is)
/// has to stay, and so have the ends of its sides: in `named`, where it is named, else in `in_other_cell` (a byte a
/// vertex). That has all middles afterwards. Complexity: linear.
std::vector<MiddleNode> settle_middles(std::span<const Triangle> triangles,
                                       std::span<const QuadraticTriangle> quadratics, std::vector<std::uint8_t>& named,
                                       std::vector<std::uint8_t>& in_other_cell);

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

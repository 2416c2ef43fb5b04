// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/smoothing/result.h"

namespace trismooth {

/// What MovingMesh::follow() did.
struct FollowResult {
  static constexpr std::size_t most_listed = 1000;

  /// Of the sweeps from where the vertices were carried to: what has moved, gone back and been untangled counts from
  /// there. `inverted` and `degenerate` count elements of the result as the reference orients them.
  SmoothingResult smoothing;
  /// The smallest and the mean shape of an element seen from the reference's: the mean ratio of the map from that
  /// triangle to this one, 1 where it is a similar one and 0 or less where it is degenerate or inverted; of a
  /// quadrilateral that of the triangle, with its diagonal, at the corner where it is smallest. Elements that are not
  /// valid in the reference are left out; NaN where there is no other.
  double min_relative_shape = 0;
  double mean_relative_shape = 0;
  /// Elements whose corners are all held, and that the boundary itself has inverted or made degenerate: no place of
  /// the free vertices mends them.
  std::int64_t invalid_held = 0;
  /// Edges between held vertices that cross or touch each other, to rounding, and do not in the reference: two pairs of
  /// vertices each. Where there are any the mesh lies over itself or on itself, inverted or not. Of more than
  /// most_listed some; none are looked for where the reference itself has a hundred times as many.
  std::vector<std::array<std::int32_t, 4>> crossings;
  /// Vertices around which the mesh lies over itself and does not in the reference, ascending: where the elements
  /// around one go round it more than once, as where a hole has been turned inside out. The first most_listed. Where
  /// there are none, nor crossings or inverted elements, no component lies over itself where the reference does not;
  /// nobody looks whether one lies wholly inside another.
  std::vector<std::int32_t> overlaps;
  /// The elements that are inverted or degenerate, ascending; the first most_listed.
  std::vector<std::int32_t> invalid;
  /// Whether a solver may go on with this mesh: no element is inverted or degenerate, and it lies over itself nowhere.
  /// False as well where the call was over before the first sweep, and for a reference with invalid elements that
  /// nothing mends.
  bool is_valid() const {
    return smoothing.inverted == 0 && smoothing.degenerate == 0 && crossings.empty() && overlaps.empty();
  }

  double largest_move = 0;  ///< of a vertex from the last mesh (at first: the reference) to this one, in its units
};

}  // namespace trismooth

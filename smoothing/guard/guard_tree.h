// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace trismooth {

/// What the never-worse guard knows of a set of elements that moved vertices touch.
struct GuardMinimum {
  double before = std::numeric_limits<double>::infinity();    ///< the smallest quotient before
  double worsened = std::numeric_limits<double>::infinity();  ///< the smallest worsened_quotient()

  void join(const GuardMinimum& other) {
    before = std::min(before, other.before);
    worsened = std::min(worsened, other.worsened);
  }
};

/// The minima of blocks of elements and of groups of blocks, up to that of all: a tree of fixed fan-out. Where a few
/// blocks change, T is found again and the offending blocks are found in a time that goes with these few (and the
/// logarithm of the number of blocks), not with the mesh.
class GuardTree {
 public:
  explicit GuardTree(std::size_t blocks);

  /// The minimum of one block, to be written before update(). Blocks may be written from different threads.
  GuardMinimum& operator[](std::size_t block) { return levels_.front()[block]; }

  /// Brings the groups of the blocks up to date that were written since the last time: all of them, or those listed.
  void update();
  void update(std::span<const std::int32_t> blocks);

  /// Of all elements.
  const GuardMinimum& total() const { return levels_.back().front(); }

  /// Appends the blocks that hold an element whose worsened quotient is below `threshold`, ascending.
  void find_below(double threshold, std::vector<std::int32_t>& blocks) const;

 private:
  static constexpr std::size_t fan_out = 16;

  void join_group(std::size_t level, std::size_t group);

  std::vector<std::vector<GuardMinimum>> levels_;  ///< blocks first, the total last
};

}  // namespace trismooth

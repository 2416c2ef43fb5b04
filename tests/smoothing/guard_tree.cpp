// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/guard_tree.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::guard_tree_test {

GuardMinimum smallest_of(const std::vector<GuardMinimum>& blocks) {
  GuardMinimum smallest;
  for (const GuardMinimum& block : blocks) {
    smallest.before = std::min(smallest.before, block.before);
    smallest.worsened = std::min(smallest.worsened, block.worsened);
  }
  return smallest;
}

std::vector<std::int32_t> below(const std::vector<GuardMinimum>& blocks, double threshold) {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].worsened < threshold) {
      found.push_back(static_cast<std::int32_t>(i));
    }
  }
  return found;
}

void require_same(const GuardTree& tree, const std::vector<GuardMinimum>& blocks, double threshold) {
  const GuardMinimum smallest = smallest_of(blocks);
  REQUIRE(tree.total().before == smallest.before);
  REQUIRE(tree.total().worsened == smallest.worsened);
  std::vector<std::int32_t> found;
  tree.find_below(threshold, found);
  REQUIRE(found == below(blocks, threshold));
}

TEST_CASE("the minimum of all blocks and the blocks below a threshold are those of a look at every block") {
  test_meshes::Random random(1);
  for (const int count : {1, 2, 15, 16, 17, 255, 256, 257, 5000}) {
    CAPTURE(count);
    GuardTree tree(static_cast<std::size_t>(count));
    std::vector<GuardMinimum> blocks(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      tree[i] = blocks[i] = {random.between(-1, 1), random.between(-1, 1)};
    }
    tree.update();
    require_same(tree, blocks, -0.9);
    for (int round = 0; round < 50; ++round) {
      std::vector<std::int32_t> changed;
      for (int i = 0; i < 1 + round / 10; ++i) {
        const auto block = static_cast<std::size_t>(random.below(count));
        // Minima may rise: vertices went back.
        tree[block] = blocks[block] = {random.between(-1, 2), random.between(-1, 2)};
        changed.push_back(static_cast<std::int32_t>(block));
      }
      tree.update(changed);
      require_same(tree, blocks, random.between(-1, 1));
    }
  }
}

TEST_CASE("where no vertex has moved there is nothing below any threshold") {
  for (const std::size_t count : {0, 1, 100}) {
    GuardTree tree(count);
    tree.update();
    CHECK(tree.total().before == std::numeric_limits<double>::infinity());
    std::vector<std::int32_t> found;
    tree.find_below(tree.total().before, found);
    CHECK(found.empty());
  }
}

}  // namespace trismooth::guard_tree_test

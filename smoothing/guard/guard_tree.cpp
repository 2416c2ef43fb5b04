// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/guard_tree.h"

namespace trismooth {

GuardTree::GuardTree(std::size_t blocks) {
  levels_.emplace_back(std::max<std::size_t>(blocks, 1));
  while (levels_.back().size() > 1) {
    levels_.emplace_back((levels_.back().size() + fan_out - 1) / fan_out);
  }
}

void GuardTree::join_group(std::size_t level, std::size_t group) {
  const std::vector<GuardMinimum>& below = levels_[level - 1];
  GuardMinimum joined;
  for (std::size_t i = group * fan_out; i < std::min(below.size(), (group + 1) * fan_out); ++i) {
    joined.join(below[i]);
  }
  levels_[level][group] = joined;
}

void GuardTree::update() {
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    for (std::size_t group = 0; group < levels_[level].size(); ++group) {
      join_group(level, group);
    }
  }
}

void GuardTree::update(std::span<const std::int32_t> blocks) {
  std::vector<std::size_t> changed(blocks.begin(), blocks.end());
  std::ranges::sort(changed);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    for (std::size_t& index : changed) {
      index /= fan_out;
    }
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const std::size_t group : changed) {
      join_group(level, group);
    }
  }
}

void GuardTree::find_below(double threshold, std::vector<std::int32_t>& blocks) const {
  if (!(total().worsened < threshold)) {
    return;
  }
  std::vector<std::size_t> found{0};
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    std::vector<std::size_t> inside;
    for (const std::size_t group : found) {
      const std::vector<GuardMinimum>& below = levels_[level - 1];
      for (std::size_t i = group * fan_out; i < std::min(below.size(), (group + 1) * fan_out); ++i) {
        if (below[i].worsened < threshold) {
          inside.push_back(i);
        }
      }
    }
    found.swap(inside);
  }
  for (const std::size_t block : found) {
    blocks.push_back(static_cast<std::int32_t>(block));
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_cell_index.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace trismooth {

namespace {

/// The place of the first cell whose vertices are not below `wanted`.
template <class Level>
std::size_t lower_bound(const Level& level, std::span<const std::int32_t> wanted) {
  std::size_t begin = 0;
  std::size_t end = level.cells.size();
  while (begin < end) {
    const std::size_t middle = begin + (end - begin) / 2;
    if (std::ranges::lexicographical_compare(level[middle], wanted)) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  return begin;
}

}  // namespace

CellIndex::Level CellIndex::sorted(const CellList& cells, std::vector<std::int32_t> members) {
  Level unsorted{.cells = std::move(members), .offsets = {0}, .vertices = {}};
  for (const std::int32_t cell : unsorted.cells) {
    const auto vertices = cells[static_cast<std::size_t>(cell)];
    unsorted.vertices.insert(unsorted.vertices.end(), vertices.begin(), vertices.end());
    std::sort(unsorted.vertices.end() - static_cast<std::ptrdiff_t>(vertices.size()), unsorted.vertices.end());
    unsorted.offsets.push_back(unsorted.vertices.size());
  }
  std::vector<std::size_t> order(unsorted.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&unsorted](std::size_t a, std::size_t b) {
    const std::span<const std::int32_t> of_a = unsorted[a];
    const std::span<const std::int32_t> of_b = unsorted[b];
    return std::ranges::equal(of_a, of_b) ? a < b : std::ranges::lexicographical_compare(of_a, of_b);
  });
  Level level{.cells = {}, .offsets = {0}, .vertices = {}};
  for (const std::size_t i : order) {
    level.cells.push_back(unsorted.cells[i]);
    level.vertices.insert(level.vertices.end(), unsorted[i].begin(), unsorted[i].end());
    level.offsets.push_back(level.vertices.size());
  }
  return level;
}

void CellIndex::add(const CellList& cells, std::size_t first, std::size_t last) {
  if (first == last) {
    return;
  }
  std::vector<std::int32_t> members(last - first);
  std::iota(members.begin(), members.end(), static_cast<std::int32_t>(first));
  while (!levels_.empty() && levels_.back().cells.size() <= members.size()) {
    members.insert(members.begin(), levels_.back().cells.begin(), levels_.back().cells.end());
    levels_.pop_back();
  }
  levels_.push_back(sorted(cells, std::move(members)));
}

std::optional<std::int32_t> CellIndex::find(std::span<const std::int32_t> vertices) const {
  std::vector<std::int32_t> wanted(vertices.begin(), vertices.end());
  std::ranges::sort(wanted);
  for (const Level& level : levels_) {
    const std::size_t at = lower_bound(level, wanted);
    if (at < level.cells.size() && std::ranges::equal(level[at], wanted)) {
      return level.cells[at];
    }
  }
  return std::nullopt;
}

}  // namespace trismooth

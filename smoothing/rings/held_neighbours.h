#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trismooth {

/// The neighbours of vertices that move without having a one-ring: those that are held to a line.
class HeldNeighbours {
 public:
  /// None.
  HeldNeighbours() = default;

  /// `neighbours`: pairs (vertex, neighbour) in any order, of vertices from `first` to below `end`. Complexity: linear.
  HeldNeighbours(std::int32_t first, std::int32_t end,
                 std::span<const std::pair<std::int32_t, std::int32_t>> neighbours)
      : first_(first), offsets_(static_cast<std::size_t>(end - first) + 2, 0), neighbours_(neighbours.size()) {
    for (const auto& [vertex, neighbour] : neighbours) {
      ++offsets_[static_cast<std::size_t>(vertex - first) + 2];
    }
    for (std::size_t i = 2; i < offsets_.size(); ++i) {
      offsets_[i] += offsets_[i - 1];
    }
    for (const auto& [vertex, neighbour] : neighbours) {
      neighbours_[static_cast<std::size_t>(offsets_[static_cast<std::size_t>(vertex - first) + 1]++)] = neighbour;
    }
  }

  /// Those of a vertex from `first` on; a neighbour may be there more than once.
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    if (offsets_.empty()) {
      return {};
    }
    const auto i = static_cast<std::size_t>(vertex - first_);
    return std::span(neighbours_)
        .subspan(static_cast<std::size_t>(offsets_[i]), static_cast<std::size_t>(offsets_[i + 1] - offsets_[i]));
  }

 private:
  std::int32_t first_ = 0;
  std::vector<std::int64_t> offsets_;
  std::vector<std::int32_t> neighbours_;
};

}  // namespace trismooth

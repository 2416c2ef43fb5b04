// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trismooth {

/// A list of numbers for every number of a range: the neighbours of vertices, say.
class NumberLists {
 public:
  /// Lists of nothing.
  NumberLists() = default;

  /// `pairs` (number, entry), of numbers from `first` to below `end`. Lists keep their order. Complexity: linear.
  NumberLists(std::int32_t first, std::int32_t end, std::span<const std::pair<std::int32_t, std::int32_t>> pairs)
      : first_(first), offsets_(static_cast<std::size_t>(end - first) + 2, 0), entries_(pairs.size()) {
    for (const auto& [number, entry] : pairs) {
      ++offsets_[static_cast<std::size_t>(number - first) + 2];
    }
    for (std::size_t i = 2; i < offsets_.size(); ++i) {
      offsets_[i] += offsets_[i - 1];
    }
    for (const auto& [number, entry] : pairs) {
      entries_[static_cast<std::size_t>(offsets_[static_cast<std::size_t>(number - first) + 1]++)] = entry;
    }
  }

  /// The list of a number; where there are no lists, that is empty.
  std::span<const std::int32_t> operator[](std::int32_t number) const {
    if (offsets_.empty()) {
      return {};
    }
    const auto i = static_cast<std::size_t>(number - first_);
    return std::span(entries_).subspan(static_cast<std::size_t>(offsets_[i]),
                                       static_cast<std::size_t>(offsets_[i + 1] - offsets_[i]));
  }

 private:
  std::int32_t first_ = 0;
  std::vector<std::int64_t> offsets_;
  std::vector<std::int32_t> entries_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/cell_list.h"

namespace trismooth {

/// Finds cells by their vertices, in whatever order these are. For n cells in all, n log^2 n, however few are added at
/// a time; linear memory.
class CellIndex {
 public:
  /// Cells first to last - 1 of the list are found from now on.
  void add(const CellList& cells, std::size_t first, std::size_t last);

  /// One of the cells that have these vertices, or nothing.
  std::optional<std::int32_t> find(std::span<const std::int32_t> vertices) const;

 private:
  /// Cells by their vertices, and these vertices in ascending order, one cell after the other.
  struct Level {
    std::vector<std::int32_t> cells;
    std::vector<std::size_t> offsets;
    std::vector<std::int32_t> vertices;

    std::span<const std::int32_t> operator[](std::size_t i) const {
      return std::span(vertices).subspan(offsets[i], offsets[i + 1] - offsets[i]);
    }
  };

  static Level sorted(const CellList& cells, std::vector<std::int32_t> members);

  std::vector<Level> levels_;  ///< each has more cells than the next
};

}  // namespace trismooth

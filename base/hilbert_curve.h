// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "trismooth/base/host_device.h"

namespace trismooth {

namespace detail {

/// The Hilbert curve of one square runs through its quadrants in the order (0,0), (0,1), (1,1), (1,0) of the leading
/// bits (x, y). Inside the first it is transposed and inside the last transposed about the other diagonal. Those two
/// generate four orientations, each its own inverse, so two bits hold one: 1 = x and y are exchanged, 2 = both are
/// complemented. An entry is a walk down four levels at once: their eight bits of the index, and above them the
/// orientation that they lead to. Subscript: orientation, four bits of x, four bits of y.
using HilbertTable = std::array<std::uint16_t, std::size_t{4} * 16 * 16>;

constexpr HilbertTable make_hilbert_table() {
  HilbertTable table{};
  for (unsigned entry = 0; entry < table.size(); ++entry) {
    unsigned orientation = entry >> 8;
    unsigned index = 0;
    for (int level = 3; level >= 0; --level) {
      const unsigned complement = orientation >> 1;
      unsigned x = ((entry >> (4 + level)) & 1U) ^ complement;
      unsigned y = ((entry >> level) & 1U) ^ complement;
      if ((orientation & 1U) != 0) {
        const unsigned old_x = x;
        x = y;
        y = old_x;
      }
      index = index << 2 | (2 * x + (x ^ y));
      if (y == 0) {
        orientation ^= x == 0 ? 1U : 3U;
      }
    }
    table[entry] = static_cast<std::uint16_t>(orientation << 8 | index);
  }
  return table;
}

inline constexpr HilbertTable hilbert_table = make_hilbert_table();

}  // namespace detail

/// The place of cell (x, y) along the Hilbert curve of a square of 2^order x 2^order cells: a bijection onto
/// [0, 4^order) under which cells that follow each other share a side. The curve starts at (0, 0) and ends at
/// (2^order - 1, 0). Sorting points by it puts points that are near each other in the plane near each other in memory.
/// `order` is 1 to 32; x and y are below 2^order (no check). One look-up in the table (a copy of
/// detail::hilbert_table in memory that the caller can read) for every four levels.
constexpr TRISMOOTH_HOST_DEVICE std::uint64_t hilbert_index(const std::uint16_t* table, std::uint32_t x,
                                                            std::uint32_t y, int order) {
  const int levels = (order + 3) & ~3;
  // Levels above the square's own only lead through first quadrants, each of which transposes the curve.
  auto orientation = static_cast<unsigned>(levels - order) & 1U;
  std::uint64_t index = 0;
  for (int shift = levels - 4; shift >= 0; shift -= 4) {
    const unsigned entry = table[orientation << 8 | ((x >> shift) & 15U) << 4 | ((y >> shift) & 15U)];
    index = index << 8 | (entry & 255U);
    orientation = entry >> 8;
  }
  return index;
}

constexpr std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, int order = 32) {
  return hilbert_index(detail::hilbert_table.data(), x, y, order);
}

}  // namespace trismooth

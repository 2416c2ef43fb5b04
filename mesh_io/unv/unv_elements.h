// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace trismooth {

/// How a universal file lists an element that is a cell.
struct UnvShape {
  std::uint8_t type = 0;         ///< of the cell
  std::size_t nodes = 0;         ///< 0: no such element is known
  std::int64_t descriptor = 0;   ///< of those that are written
  const std::uint8_t* places{};  ///< of vertex i among the element's nodes; null: i

  std::size_t place(std::size_t i) const { return places == nullptr ? i : places[i]; }
};

inline constexpr std::size_t most_unv_nodes = 20;

/// The shape of elements of that FE descriptor with so many nodes; none where it is not known.
const UnvShape& unv_shape(std::int64_t descriptor, std::int64_t nodes);
/// The shape of the elements that such cells are written as; none for cells that a universal file does not hold.
const UnvShape& unv_shape_of_cell(std::uint8_t type);
/// Whether elements of that descriptor have a record of their orientation before their nodes.
bool is_unv_beam(std::int64_t descriptor);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace trismooth {

/// How many vertices the cells of a type have: both bounds included.
struct CellSize {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();

  bool allows(std::size_t vertices) const { return least <= vertices && vertices <= most; }
};

/// For VTK's cell types; any number for a type that is not known here. VTK's own classes stop the program on many cells
/// that have fewer vertices, and no other format holds them.
CellSize cell_size_of(std::uint8_t type);

/// For messages: "of type 7 has 2 vertices; expected 3 or more".
std::string describe_wrong_size(std::uint8_t type, std::size_t vertices);

}  // namespace trismooth

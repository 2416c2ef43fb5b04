// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// How many cells there are of each type, but for those of `kept`, of which there are none.
std::array<std::size_t, 256> count_other_cells(const CellList& cells, std::span<const std::uint8_t> kept);

/// The cells whose type is none of `kept`, counted by type, for messages: "2 quads, 1 poly-vertex". Empty where there
/// are none.
std::string describe_other_cells(const CellList& cells, std::span<const std::uint8_t> kept);

/// The type's name in VTK's way, "quadratic_edge", or its number.
std::string cell_type_name(std::size_t type);

/// All types for which is_meant(type) is true.
template <class Predicate>
std::vector<std::uint8_t> cell_types_where(const Predicate& is_meant) {
  std::vector<std::uint8_t> types;
  for (unsigned type = 0; type < 256; ++type) {
    if (is_meant(static_cast<std::uint8_t>(type))) {
      types.push_back(static_cast<std::uint8_t>(type));
    }
  }
  return types;
}

}  // namespace trismooth

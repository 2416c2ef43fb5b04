// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Boundaries of an ADCIRC grid that a document from elsewhere has as groups of lines.
struct AdcircLineBoundaries {
  struct Boundary {
    bool is_open = false;
    std::int64_t type = 0;            ///< IBTYPE of land: 0, or 1 of an island
    std::vector<std::int32_t> nodes;  ///< in their order: the mesh is to the left
  };

  std::vector<Boundary> boundaries;        ///< by group
  std::vector<std::uint8_t> is_written{};  ///< per cell: 1 for the lines of these; empty where there are none
  std::vector<std::string> losses{};       ///< why groups of such names are none, one sentence each
};

/// The groups of lines (find_cell_groups()) whose names begin with "open", "land", "mainland" or "island", in any case
/// of letters. Their lines are edges of the mesh's boundary that do not branch; each piece of them is a boundary. A
/// closed one of land is an island where it is around a hole; around the mesh its first node stands at the end again.
/// None where the document has boundaries as sets of points. Complexity: n log n.
AdcircLineBoundaries find_adcirc_line_boundaries(const MeshDocument& document);

}  // namespace trismooth

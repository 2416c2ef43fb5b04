// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Cells of lines and faces whose sides have nodes in their middles.
enum class CurvedCells : std::uint8_t {
  all,              ///< quadratic edges, triangles of six nodes, quadrilaterals of eight or nine
  eight_node_quads  ///< quadrilaterals of eight
};

/// True where the document has any of them. Linear.
bool has_curved_cells(const MeshDocument& document, CurvedCells which = CurvedCells::all);

/// The document with the line, the triangle or the quadrilateral of its corners in place of each of them, without the
/// points that nothing but their middles was at; without an original. For formats that do not hold them. Linear.
MeshDocument with_straight_cells(const MeshDocument& document, CurvedCells which = CurvedCells::all);

}  // namespace trismooth

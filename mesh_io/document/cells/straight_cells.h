// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// True where the document has cells of lines and faces whose sides have nodes in their middles: quadratic edges,
/// triangles of six nodes, quadrilaterals of eight or nine.
bool has_curved_cells(const MeshDocument& document);

/// The document with the line, the triangle or the quadrilateral of its corners in place of each such cell, without the
/// points that nothing but their middles was at; without an original. For formats that hold straight cells only.
/// Linear.
MeshDocument with_straight_cells(const MeshDocument& document);

}  // namespace trismooth

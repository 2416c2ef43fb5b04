// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// How many quadrilaterals of four nodes the document has. Linear.
std::size_t count_quads(const MeshDocument& document);

/// Whether it has quadrilaterals of eight or nine nodes. Linear.
bool has_curved_quads(const MeshDocument& document);

/// The document with two triangles in place of each quadrilateral of four nodes, into which its shorter diagonal cuts
/// it; the other one where that lies outside. Each has the quadrilateral's row of the cell arrays, and is in its sets.
/// Without an original. For formats that hold triangles only. Linear.
MeshDocument with_halved_quads(const MeshDocument& document);

}  // namespace trismooth

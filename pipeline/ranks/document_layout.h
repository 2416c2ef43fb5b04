// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// What the values of a document's points are, without the values: as bytes for other ranks. Equal bytes mean the same
/// arrays in the same order. Local.
std::vector<char> packed_point_layout(const MeshDocument& document);
/// What the values of a document's cells are, without the values: as bytes for other ranks. Equal bytes mean the same
/// arrays in the same order. Local.
std::vector<char> packed_cell_layout(const MeshDocument& document);

/// Gives a document without points the type of coordinates and the point arrays of that layout, without rows. Local.
void take_point_layout(const std::vector<char>& layout, MeshDocument& document);
/// Gives a document without cells the cell arrays of that layout, without rows. Local.
void take_cell_layout(const std::vector<char>& layout, MeshDocument& document);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"

class vtkPoints;

namespace trismooth {

/// How many places points of several pieces share. `points`: those of all pieces, one piece after the other; what is
/// not finite has no place. Complexity: n log n in them.
std::size_t count_shared_places(std::span<const VtkXmlPiece> pieces, vtkPoints& points);

}  // namespace trismooth

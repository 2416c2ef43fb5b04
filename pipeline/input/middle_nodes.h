#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/smoothing/middle_nodes.h"

namespace trismooth {

struct PlanarMesh;

/// Tells which middles of the mesh's quadratic triangles follow their sides (mesh.middles), and at which fraction of
/// them they lie (`points`: x, y, z of every vertex of the document, as the file has them), and holds where it cannot
/// be, in `named` (a byte a vertex, or empty) and mesh.in_other_cell: see middle_nodes.h of smoothing.
void settle_middles(PlanarMesh& mesh, std::span<const double> points, std::vector<std::uint8_t>& named);

}  // namespace trismooth

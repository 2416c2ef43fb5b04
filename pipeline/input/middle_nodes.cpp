#include "trismooth/pipeline/input/middle_nodes.h"

#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

void settle_middles(PlanarMesh& mesh, std::vector<std::uint8_t>& named) {
  mesh.middles = settle_middles(mesh.triangles, mesh.quadratics, named, mesh.in_other_cell);
}

}  // namespace trismooth

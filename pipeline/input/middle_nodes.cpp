#include "trismooth/pipeline/input/middle_nodes.h"

#include <array>
#include <cstddef>

#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

void settle_middles(PlanarMesh& mesh, std::span<const double> points, std::vector<std::uint8_t>& named) {
  mesh.middles = settle_middles(mesh.triangles, mesh.quadratics, named, mesh.in_other_cell);
  find_shares(mesh.middles, [points](std::int32_t vertex) {
    const double* const p = points.data() + 3 * static_cast<std::size_t>(vertex);
    return std::array<double, 3>{p[0], p[1], p[2]};
  });
}

}  // namespace trismooth

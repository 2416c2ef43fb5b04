#include "trismooth/smoothing/rings/fixed_vertices.h"

#include <cstddef>

#include "trismooth/base/hold.h"

namespace trismooth {

void hold_named_vertices(const Constraints& constraints, std::span<std::uint8_t> reasons) {
  for (std::size_t v = 0; v < constraints.fixed.size(); ++v) {
    if (constraints.fixed[v] != 0) {
      reasons[v] |= hold::named;
    }
  }
  for (std::size_t v = 0; v < constraints.other_cells.size(); ++v) {
    if (constraints.other_cells[v] != 0) {
      reasons[v] |= hold::other_cell;
    }
  }
  for (const std::int32_t v : constraints.fixed_ids) {
    reasons[v] |= hold::named;
  }
}

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints) {
  check_constraints(constraints, topology.vertex_count, std::ssize(triangles));
  std::vector<std::uint8_t> reasons = topology.hold;
  hold_named_vertices(constraints, reasons);
  if (!constraints.regions.empty()) {
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(topology.twins.size()); ++h) {
      const std::int32_t twin = topology.twins[h];
      if (twin > h && constraints.regions[h / 3] != constraints.regions[twin / 3]) {
        reasons[triangles[h / 3][h % 3]] |= hold::interface;
        reasons[triangles[h / 3][(h % 3 + 1) % 3]] |= hold::interface;
      }
    }
  }
  return reasons;
}

}  // namespace trismooth

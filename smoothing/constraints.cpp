#include "trismooth/smoothing/constraints.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace trismooth {

namespace {

void require_length(std::string_view what, std::size_t length, std::int64_t expected) {
  if (length != 0 && static_cast<std::int64_t>(length) != expected) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(length) + " entries, expected " +
                                std::to_string(expected) + " or none");
  }
}

}  // namespace

void check_constraints(const Constraints& constraints, std::int32_t vertex_count, std::int64_t triangle_count) {
  require_length("Constraints::fixed", constraints.fixed.size(), vertex_count);
  require_length("Constraints::other_cells", constraints.other_cells.size(), vertex_count);
  require_length("Constraints::regions", constraints.regions.size(), triangle_count);
  for (const std::int32_t v : constraints.fixed_ids) {
    if (v < 0 || v >= vertex_count) {
      throw std::invalid_argument("fixed vertex " + std::to_string(v) + " is not one of the " +
                                  std::to_string(vertex_count) + " vertices");
    }
  }
}

std::vector<std::uint8_t> fixed_vertices(const TriangleTopology& topology, std::span<const Triangle> triangles,
                                         const Constraints& constraints) {
  check_constraints(constraints, topology.vertex_count, std::ssize(triangles));
  std::vector<std::uint8_t> reasons = topology.hold;
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

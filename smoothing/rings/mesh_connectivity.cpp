// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/mesh_connectivity.h"

#include <optional>
#include <utility>

#include "trismooth/smoothing/rings/fixed_vertices.h"

namespace trismooth {

MeshConnectivity::MeshConnectivity(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers) {
  if (std::optional<ListedRings> listed = find_listed_rings(vertex_count, triangles, workers)) {
    known_ = std::move(*listed);
  } else {
    known_ = connect_triangles(vertex_count, triangles, workers);
  }
}

MeshConnectivity::MeshConnectivity(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers)
    : known_(connect_triangles(vertex_count, elements, workers)) {}

const TriangleComponents& MeshConnectivity::components() const {
  const auto* const listed = std::get_if<ListedRings>(&known_);
  return listed != nullptr ? listed->components : std::get<TriangleTopology>(known_);
}

std::vector<std::uint8_t> MeshConnectivity::fixed_vertices(std::span<const Triangle> triangles,
                                                           const Constraints& constraints, Workers& workers) const {
  return std::visit(
      [&](const auto& known) { return trismooth::fixed_vertices(known, triangles, constraints, workers); }, known_);
}
std::vector<std::uint8_t> MeshConnectivity::fixed_vertices(std::span<const MixedElement> elements,
                                                           const Constraints& constraints, Workers& workers) const {
  return trismooth::fixed_vertices(std::get<TriangleTopology>(known_), elements, constraints, workers);
}

OneRings MeshConnectivity::one_rings(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                                     std::span<const std::uint8_t> fixed, Workers& workers) const& {
  return std::visit([&](const auto& known) { return trismooth::one_rings(known, triangles, reversed, fixed, workers); },
                    known_);
}

OneRings MeshConnectivity::one_rings(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                                     std::span<const std::uint8_t> fixed, Workers& workers) && {
  return std::visit(
      [&](auto& known) { return trismooth::one_rings(std::move(known), triangles, reversed, fixed, workers); }, known_);
}

OneRings MeshConnectivity::one_rings(std::span<const MixedElement> elements, std::span<const std::uint8_t> reversed,
                                     std::span<const std::uint8_t> fixed, Workers& workers) const {
  return trismooth::one_rings(std::get<TriangleTopology>(known_), elements, reversed, fixed, workers);
}

}  // namespace trismooth

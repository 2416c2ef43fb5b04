// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "trismooth/base/triangle_topology.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/listed_rings.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;

/// How the elements of flat arrays hang together, found in the way that is quickest for them. What it answers does not
/// depend on the way. `elements`, triangles or MixedElements, are the same in every call.
class MeshConnectivity {
 public:
  /// Of no vertex.
  MeshConnectivity() = default;

  /// Throws as connect_triangles() does. Complexity: linear.
  MeshConnectivity(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers);
  MeshConnectivity(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers);

  const TriangleComponents& components() const;

  /// As the function of this name.
  std::vector<std::uint8_t> fixed_vertices(std::span<const Triangle> triangles, const Constraints& constraints,
                                           Workers& workers) const;
  std::vector<std::uint8_t> fixed_vertices(std::span<const MixedElement> elements, const Constraints& constraints,
                                           Workers& workers) const;

  /// As the function of this name.
  OneRings one_rings(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                     std::span<const std::uint8_t> fixed, Workers& workers) const&;
  /// one_rings(), for the last time: the memory of what is known goes into the rings.
  OneRings one_rings(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                     std::span<const std::uint8_t> fixed, Workers& workers) &&;
  OneRings one_rings(std::span<const MixedElement> elements, std::span<const std::uint8_t> reversed,
                     std::span<const std::uint8_t> fixed, Workers& workers) const;

 private:
  std::variant<ListedRings, TriangleTopology> known_;  ///< with quadrilaterals the latter
};

}  // namespace trismooth

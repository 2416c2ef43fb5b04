// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth {

class Workers;
struct MeshPart;

/// All that is to be known of a mesh's connectivity, whoever found it (the host or a device: the same in every number).
struct MeshRings {
  std::vector<std::uint8_t> fixed;        ///< per vertex: why it is fixed, bits of namespace hold; 0 is free
  std::vector<std::uint8_t> reversed;     ///< per element: 1 where it is listed clockwise in the consistent orientation
  std::int32_t components = 0;            ///< connected through edges with exactly two triangles
  std::int64_t reoriented_triangles = 0;  ///< listed against the majority of their component
  OneRings rings;                         ///< of the free vertices
  Slidable slidable;                      ///< the fixed vertices that may slide
  LayersResult layers;                    ///< what was held since it is flat on purpose
  std::shared_ptr<const MeshPart> part;   ///< where the mesh is a part of another one; null: it is not
  Topology found_by = Topology::host;     ///< who found it: host, halfedge or device
  std::string note;                       ///< what the user is to know of how they were found, or empty
};

/// A copy that takes the rings, which are most of it, away from `mesh`.
MeshRings with_rings_of(MeshRings& mesh);

/// Finds it on the host, from the list of elements alone. `points` are in the local frame, one for every vertex.
/// `layers`: what becomes of layers; by default connectivity alone counts. Throws MeshError and std::invalid_argument
/// as connect_triangles() and fixed_vertices() do.
MeshRings find_mesh_rings(std::span<const Point2<double>> points, const ElementList& elements,
                          const Constraints& constraints, Workers& workers, Layers layers = Layers::smooth);

}  // namespace trismooth

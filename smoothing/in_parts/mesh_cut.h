// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/in_parts/thread_team.h"
#include "trismooth/smoothing/parts/mesh_part.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// A part cut out of a mesh that this process has as a whole: what Backend::prepare() takes.
struct CutPart {
  MeshRings mesh;                     ///< in the part's numbers, MeshRings::part with it
  OwnElements elements;               ///< in its numbers: those without a free vertex that this part counts
  std::vector<Point2<double>> local;  ///< its vertices in the local frame
  BulkVector<std::int32_t> vertices;  ///< the number in the whole mesh of each of its vertices, ascending

  bool is_ghost(std::size_t vertex) const { return mesh.part->ghosts[vertex] != 0; }
};

/// Cuts a mesh into as many parts as the team has, along a Hilbert curve: each gets the same number of free vertices.
/// Parts know one layer of ghosts, have the colours of the whole, and the team's messengers. `mesh`: nothing slides in
/// it. `elements`, `local`: as Backend::prepare() has them. No result of smoothing depends on where it is cut.
/// Complexity: linear, times the parts.
std::vector<CutPart> cut_into_parts(const MeshRings& mesh, const ElementList& elements,
                                    std::span<const Point2<double>> local, const ThreadTeam& team, bool has_progress,
                                    Workers& workers);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/pipeline/file_groups.h"
#include "trismooth/pipeline/ranks/joined/rank_mesh.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// Leaves the implied sets of the file (Piece::implied_by) what nothing else of the mesh holds, as find_held_sets()
/// does: `held`, why each vertex of the overlap is held, gets hold::named where such a set has the vertex and it is
/// inside the mesh, of no line or point cell and not between regions. The sets that hold any, on all ranks. Collective.
std::vector<FilePointSet> settle_implied_sets(const PieceFiles& files, const RankMesh& mesh,
                                              const RankTopology& topology, std::vector<std::uint8_t>& held);

/// The names, quoted, of arrays of markers of points (may_be_markers()) with a value other than 0. What they mark is
/// not found in pieces. Empty where there are none, or rank 0 has read the file and found it. Collective.
std::string unjudged_markers(const PieceFiles& files, const mpi::Communicator& ranks);

}  // namespace trismooth

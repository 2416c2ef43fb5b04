// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/partition.h"
#include "trismooth/pipeline/quads.h"
#include "trismooth/pipeline/ranks/mesh_share.h"
#include "trismooth/pipeline/ranks/piece_files.h"

namespace trismooth {

/// Makes a piece for each rank of what all ranks have read of one file. With Partition::keep a rank has a range of the
/// file's cells, and ranges are as long as each other; else points are bisected, and a cell is where its smallest
/// corner is. A piece has the points of its cells; those of no cell are somewhere, once. Points and cells keep their
/// order and their numbers in the file: Piece::ids, cell_ids, triangle_ids. The pieces get the point array
/// GlobalPointIds and the cell array GlobalCellIds of these numbers; other arrays of these names, and cell arrays
/// vtkGhostType, get others.
///
/// `quads`: what becomes of quadrilaterals; `input`: the file, for messages. `output`: the parallel file to be written,
/// if any. Collective. Throws ReadError on all ranks for more points or cells than 32 bits number on one of them, and
/// where the output's pieces are .vtp and cannot hold the cells, std::invalid_argument. Notes go to `notes`, on rank 0.
/// Complexity: n log n in what a rank reads and gets. No rank has the whole mesh, unless it has read it.
PieceFiles shared_out(MeshShare share, Partition partition, Quads quads, const std::filesystem::path& input,
                      const std::optional<std::filesystem::path>& output, const mpi::Communicator& ranks,
                      Workers& workers, std::vector<std::string>& notes);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an Exodus II file, `bytes` being the whole of it. Elements of all blocks become cells in the file's order; the
/// sides of side sets become lines behind them, an edge one line. Ids of blocks and side sets are the cell array
/// "exodus:block" with their names, of which side sets that share sides are sets of cells as well; so are element sets.
/// Node sets are sets of points, ids of nodes their labels. Variables at nodes and elements become arrays, of the last
/// time step; those at nodes are written back where there is one step. All else stays in the file that is written back.
/// Throws ReadError.
MeshDocument read_exodus(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth

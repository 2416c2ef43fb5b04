// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// Appends `count` cells of a type (a VTK number) with `vertices` vertices each, whose connectivity, the last
/// `vertices`
/// * `count` numbers, is 0 and the reader's to fill. Returns the first one's index. O(count), by all workers.
std::size_t append_uniform_cells(CellList& cells, std::uint8_t type, std::size_t vertices, std::size_t count,
                                 const FileWorkers& workers);

}  // namespace trismooth

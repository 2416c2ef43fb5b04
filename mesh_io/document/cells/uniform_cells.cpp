// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/uniform_cells.h"

#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"

namespace trismooth {

std::size_t append_uniform_cells(CellList& cells, std::uint8_t type, std::size_t vertices, std::size_t count,
                                 const FileWorkers& workers) {
  const std::size_t first = cells.size();
  const std::size_t first_corner = cells.connectivity.size();
  shared_resize(cells.connectivity, first_corner + count * vertices, cells.offsets, first + count + 1, workers.workers);
  shared_resize(cells.types, first + count, workers.workers);
  for_file_blocks(workers, count, sizeof(std::int64_t), [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      cells.offsets[first + cell + 1] = static_cast<std::int64_t>(first_corner + (cell + 1) * vertices);
      cells.types[first + cell] = type;
    }
  });
  return first;
}

}  // namespace trismooth

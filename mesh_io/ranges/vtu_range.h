// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/ranges/number_range.h"

namespace trismooth {

/// What a .vtu file says it holds.
struct VtuCounts {
  std::uint64_t points = 0;
  std::uint64_t cells = 0;
};

/// The counts of a file that can be read by ranges: of one piece, whose arrays all are of numbers, raw in the appended
/// section, compressed or not. Reads what is in front of that section. Throws ReadError for other files, which may be
/// as good, and where the build has no VTK.
VtuCounts count_vtu(const std::filesystem::path& path);

/// Reads the points and the cells of these numbers, with their rows of the arrays, by the rules that the whole file is
/// read by; corners are numbers of points in the whole file. `with_fields`: the arrays of the whole mesh too. Without
/// an original. Throws ReadError where anything is wrong, or unusual; the message is not that of the whole file.
/// Complexity: linear in what is read, and in the blocks of compressed arrays.
MeshDocument read_vtu_range(const std::filesystem::path& path, NumberRange points, NumberRange cells, bool with_fields,
                            const FileWorkers& workers);

}  // namespace trismooth

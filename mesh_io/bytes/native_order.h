// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// Turns words of `word_size` bytes (1, 2, 4 or 8) of that byte order into those of this machine, on all workers. What
/// is behind the last whole word stays.
void to_native_order(std::byte* bytes, std::size_t size, std::size_t word_size, bool big_endian,
                     const FileWorkers& workers);

}  // namespace trismooth

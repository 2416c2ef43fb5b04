// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"

namespace trismooth {

/// Whether the bytes begin as those of a file that gzip has compressed.
bool is_gzip(std::string_view bytes);

/// What the bytes are decompressed: of all their members, one behind the other. Throws ReadError, which names `path`,
/// where they are damaged, cut off, or followed by anything else, and std::bad_alloc. Memory: that of the result, and
/// as much again at most while it grows.
MemoryBlock gunzip(const std::filesystem::path& path, std::string_view bytes);

/// Hands `bytes`, compressed as one member at gzip's level 6, to `sink`. It holds no name and no time: the same bytes
/// give the same ones, for every number of workers. Throws std::bad_alloc and what the sink throws.
void write_gzip(std::string_view bytes, const ByteSink& sink, const FileWorkers& workers);

}  // namespace trismooth

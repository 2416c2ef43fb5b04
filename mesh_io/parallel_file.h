// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/file_format.h"

namespace trismooth {

/// Whether the path's extension (any case) is that of a mesh in pieces: a small file that names those that hold them.
bool names_parallel_file(const std::filesystem::path& path);

/// A piece, as a parallel file names it.
struct PieceName {
  std::string source;     ///< its file, from the folder of the parallel file
  std::size_t begin = 0;  ///< where that stands in the bytes of the parallel file
  std::size_t end = 0;
};

/// What a parallel file says of its pieces.
struct ParallelFile {
  FileFormat piece_format = FileFormat::vtu;
  std::vector<PieceName> pieces;
};

/// Reads VTK's .pvtu and .pvtp, whose bytes are `bytes`. Throws ReadError for what is none, or names no pieces, one
/// twice, or itself, and where the build has no VTK.
ParallelFile read_parallel_file(const std::filesystem::path& path, std::string_view bytes);

/// The file of a piece: the source is looked for from the folder of the parallel file.
std::filesystem::path piece_path(const std::filesystem::path& parallel_file, std::string_view source);

/// The bytes of the parallel file with other sources, one for each piece.
std::string with_sources(std::string_view bytes, const ParallelFile& file, std::span<const std::string> sources);

}  // namespace trismooth

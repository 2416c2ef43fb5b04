// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"

namespace trismooth {

/// Another file that a file names by INCLUDE.
struct NastranInclude {
  std::size_t source = 0;      ///< the file
  std::filesystem::path name;  ///< as it is written there
  std::size_t begin = 0;       ///< where the statement stands, with all its lines
  std::size_t end = 0;         ///< where the next line begins
};

/// One of the files that a deck consists of, at one place: a file that is included twice is two sources.
struct NastranSource {
  std::filesystem::path path;
  FileBytes bytes;
  std::vector<std::uint64_t> grids;    ///< where each GRID begins, in the file's order
  std::vector<std::int32_t> vertices;  ///< the vertex of each; empty where GRID i is vertex i
  std::vector<NastranInclude> includes;
};

}  // namespace trismooth

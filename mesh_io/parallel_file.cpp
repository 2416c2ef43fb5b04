// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/parallel_file.h"

namespace trismooth {

bool names_parallel_file(const std::filesystem::path& path) {
  // (What names them could be compressed, but the pieces are beside it: nobody would have one file of it.)
  const std::string extension = names_gzip(path) ? "" : extension_of(path);
  return extension == ".pvtu" || extension == ".pvtp";
}

std::filesystem::path piece_path(const std::filesystem::path& parallel_file, std::string_view source) {
  return (parallel_file.parent_path() / source).lexically_normal();
}

}  // namespace trismooth

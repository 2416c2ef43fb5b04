#include "trismooth/mesh_io/parallel_file.h"

namespace trismooth {

bool names_parallel_file(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".pvtu" || extension == ".pvtp";
}

std::filesystem::path piece_path(const std::filesystem::path& parallel_file, std::string_view source) {
  return (parallel_file.parent_path() / source).lexically_normal();
}

}  // namespace trismooth

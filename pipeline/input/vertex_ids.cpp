#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

std::vector<std::int64_t> read_vertex_numbers(const std::filesystem::path& path, std::int64_t vertex_count) {
  const FileBytes bytes = read_file_bytes(path);
  TextScanner scanner(bytes, path, TextScanner::Comments::hash);
  std::vector<std::int64_t> ids;
  while (!scanner.at_end()) {
    if (vertex_count == 0) {
      throw ReadError(path, "names vertices, but the mesh has none; leave the file out");
    }
    ids.push_back(scanner.next_integer("a vertex number", 0, vertex_count - 1));
  }
  return ids;
}

std::vector<std::int32_t> read_vertex_ids(const std::filesystem::path& path, std::int64_t vertex_count) {
  const std::vector<std::int64_t> numbers = read_vertex_numbers(path, vertex_count);
  return {numbers.begin(), numbers.end()};
}

}  // namespace trismooth

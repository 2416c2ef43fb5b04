#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/point_ids.h"
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

std::vector<std::int32_t> read_vertex_labels(const std::filesystem::path& path, const MeshDocument& document) {
  if (!document.first_point_label) {
    throw std::invalid_argument("'--fixed-labels': a file of " + std::string(title_of(document.format)) +
                                " gives its points no numbers of its own; --fixed-ids takes their rows, which count "
                                "from 0");
  }
  const std::int64_t first = *document.first_point_label;
  const PointIds labels(document.point_labels);
  const auto find = [&](std::int64_t label) -> std::optional<std::int32_t> {
    if (!document.point_labels.empty()) {
      return labels.find(label);
    }
    const std::uint64_t place = static_cast<std::uint64_t>(label) - static_cast<std::uint64_t>(first);
    return place < document.point_count() ? std::optional(static_cast<std::int32_t>(place)) : std::nullopt;
  };
  const FileBytes bytes = read_file_bytes(path);
  TextScanner scanner(bytes, path, TextScanner::Comments::hash);
  std::vector<std::int32_t> ids;
  while (!scanner.at_end()) {
    const std::int64_t label = scanner.next_integer("the label of a vertex", std::numeric_limits<std::int64_t>::min(),
                                                    std::numeric_limits<std::int64_t>::max());
    const std::optional<std::int32_t> vertex = find(label);
    if (!vertex) {
      throw ReadError(path, "names the vertex " + std::to_string(label) + ", and no point of the mesh has that label");
    }
    ids.push_back(*vertex);
  }
  return ids;
}

}  // namespace trismooth

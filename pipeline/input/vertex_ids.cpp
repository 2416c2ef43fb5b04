// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/global_ids.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/document/point_labels.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

namespace {

TextScanner scanner_of(std::string_view bytes, const std::filesystem::path& path) {
  return {bytes, path, TextScanner::Comments::hash, bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0};
}

}  // namespace

std::vector<std::int64_t> read_vertex_numbers(const std::filesystem::path& path, std::int64_t vertex_count) {
  const FileBytes bytes = read_file_bytes(path);
  TextScanner scanner = scanner_of(bytes, path);
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

namespace {

/// Finds points by their labels.
class LabelledPoints {
 public:
  /// Throws std::invalid_argument where the document's file gives none; `argument` asks for them, and `rows` takes
  /// rows.
  LabelledPoints(const MeshDocument& document, const std::string& argument, const std::string& rows)
      : document_(document), labels_(labels_of(document)), ids_(labels_) {
    if (!document.first_point_label && labels_.empty()) {
      throw std::invalid_argument(argument + ": a file of " + std::string(title_of(document.format)) +
                                  " gives its points no numbers of its own; " + rows +
                                  " takes their rows, which count from 0");
    }
    if (ids_.first_repeated()) {
      throw std::invalid_argument(argument + ": the file gives several points the number " +
                                  std::to_string(labels_[*ids_.first_repeated()]) + "; " + rows +
                                  " takes their rows, which count from 0");
    }
  }

  std::optional<std::int32_t> find(std::int64_t label) const {
    if (!labels_.empty()) {
      return ids_.find(label);
    }
    const std::uint64_t place =
        static_cast<std::uint64_t>(label) - static_cast<std::uint64_t>(*document_.first_point_label);
    return place < document_.point_count() ? std::optional(static_cast<std::int32_t>(place)) : std::nullopt;
  }

  static std::string unknown(std::int64_t label) {
    return "names the vertex " + std::to_string(label) + ", and no point of the mesh has that label";
  }

 private:
  /// Of all points; none where they count on from the first, or there are none.
  static std::vector<std::int64_t> labels_of(const MeshDocument& document) {
    const DataArray* const global = document.first_point_label ? nullptr : find_global_ids(document);
    if (global == nullptr || global->components != 1 || global->type == ScalarType::float32 ||
        global->type == ScalarType::float64) {
      return document.point_labels;
    }
    std::vector<std::int64_t> labels(document.point_count());
    for (std::size_t v = 0; v < labels.size(); ++v) {
      labels[v] = point_label(*global, v);
    }
    return labels;
  }

  const MeshDocument& document_;
  std::vector<std::int64_t> labels_;
  PointIds ids_;
};

}  // namespace

std::vector<std::int32_t> vertices_of_labels(std::span<const std::int64_t> labels, const MeshDocument& document,
                                             const std::string& argument, const std::string& rows) {
  const LabelledPoints points(document, argument, rows);
  std::vector<std::int32_t> vertices;
  for (const std::int64_t label : labels) {
    const std::optional<std::int32_t> vertex = points.find(label);
    if (!vertex) {
      throw std::invalid_argument(argument + ": " + LabelledPoints::unknown(label));
    }
    vertices.push_back(*vertex);
  }
  return vertices;
}

std::vector<std::int64_t> read_labels(const std::filesystem::path& path) {
  const FileBytes bytes = read_file_bytes(path);
  TextScanner scanner = scanner_of(bytes, path);
  std::vector<std::int64_t> labels;
  while (!scanner.at_end()) {
    labels.push_back(scanner.next_integer("the label of a vertex", std::numeric_limits<std::int64_t>::min(),
                                          std::numeric_limits<std::int64_t>::max()));
  }
  return labels;
}

ReadError unknown_label(const std::filesystem::path& path, std::int64_t label) {
  return {path, LabelledPoints::unknown(label)};
}

std::vector<std::int32_t> read_vertex_labels(const std::filesystem::path& path, const MeshDocument& document) {
  const LabelledPoints points(document, "'--fixed-labels'", "--fixed-ids");
  std::vector<std::int32_t> ids;
  for (const std::int64_t label : read_labels(path)) {
    const std::optional<std::int32_t> vertex = points.find(label);
    if (!vertex) {
      throw unknown_label(path, label);
    }
    ids.push_back(*vertex);
  }
  return ids;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/triangle/triangle_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/triangle/triangle_files.h"
#include "trismooth/mesh_io/triangle/triangle_rows.h"

namespace trismooth {

namespace {

/// Both files as they were: of the nodes' coordinates may differ.
class TriangleOriginal : public OriginalFile {
 public:
  TriangleOriginal(FileBytes nodes, NumberSites sites, FileBytes elements)
      : nodes_(make_patched_original(std::move(nodes), std::move(sites))), elements_(std::move(elements)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    if (!is_triangle_elements(path)) {
      nodes_->write(path, document, added_point_arrays, added_cell_arrays, workers);
      return;
    }
    BufferedWriter writer(path);
    writer.write(elements_);
    writer.close();
  }

 private:
  std::shared_ptr<const OriginalFile> nodes_;
  FileBytes elements_;
};

/// A file of Triangle: numbers on its first line, then rows.
class TriangleFileReader {
 public:
  TriangleFileReader(const TriangleFile& file, const FileWorkers& workers)
      : scanner_(file.bytes, file.path, TextScanner::Comments::hash, begin_of_text(file.bytes.view())),
        workers_(workers) {}

  /// The next number of the first line; `missing` where that has ended.
  std::size_t next_of_header(std::string_view what, std::int64_t least, std::optional<std::int64_t> missing = {}) {
    if (missing && scanner_.at_end_of_line()) {
      return static_cast<std::size_t>(*missing);
    }
    return static_cast<std::size_t>(scanner_.next_integer(what, least, std::numeric_limits<std::int32_t>::max()));
  }

  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

  TriangleTable read_rows(std::size_t count, const TriangleColumns& columns, const std::string& row_name) {
    if (!scanner_.at_end_of_line()) {
      const std::string_view token = scanner_.next_token("the end of the line");
      scanner_.fail("expected the end of the line behind the counts, got " + quoted(token));
    }
    // Every number takes a digit and a separator, except for the separator at the end of the file.
    const std::size_t bytes_left = scanner_.text().size() - scanner_.offset();
    const std::uint64_t numbers = 1 + columns.size();
    require_room(scanner_.path(), row_name == "node" ? "nodes" : "triangles", count, 2 * numbers, bytes_left + 1);
    TriangleTable table = read_triangle_rows(scanner_, count, columns, row_name, workers_);
    if (!scanner_.at_end()) {
      const std::string_view token = scanner_.next_token("the end of the file");
      scanner_.fail("expected the end of the file behind the declared " + std::to_string(count) + " rows, got " +
                    quoted(token));
    }
    return table;
  }

 private:
  TextScanner scanner_;
  FileWorkers workers_;
};

bool is_whole_number(double value) {
  return std::trunc(value) == value && std::abs(value) <= std::numeric_limits<std::int32_t>::max();
}

/// Column `column` of rows of `columns` values; as whole numbers where all of them are.
DataArray make_attribute(std::string name, const std::vector<double>& values, std::size_t columns, std::size_t column) {
  std::vector<double> picked(values.size() / columns);
  for (std::size_t row = 0; row < picked.size(); ++row) {
    picked[row] = values[columns * row + column];
  }
  if (!std::ranges::all_of(picked, &is_whole_number)) {
    return make_data_array(std::move(name), 1, std::move(picked));
  }
  std::vector<std::int32_t> whole(picked.size());
  std::ranges::transform(picked, whole.begin(), [](double value) { return static_cast<std::int32_t>(value); });
  return make_data_array(std::move(name), 1, std::move(whole));
}

/// What the header of the nodes says besides their number: attributes of thousands of components, and no row that would
/// show them, are no mesh's.
constexpr std::int64_t most_attributes = 1000;

void require_few_attributes(const TriangleFileReader& reader, std::size_t attributes) {
  if (static_cast<std::int64_t>(attributes) > most_attributes) {
    reader.fail("declares " + std::to_string(attributes) + " attributes, more than the " +
                std::to_string(most_attributes) + " that are read");
  }
}

/// Reads the nodes to the document; returns the number of the first.
std::int32_t read_nodes(const TriangleFile& file, const FileWorkers& workers, MeshDocument& document,
                        NumberSites& sites) {
  TriangleFileReader reader(file, workers);
  const std::size_t count = reader.next_of_header("the number of nodes", 0);
  const std::size_t dimension = reader.next_of_header("the dimension", 0, 2);
  if (dimension != 2) {
    reader.fail("expected the dimension 2 of a mesh of Triangle, got " + std::to_string(dimension) +
                (dimension == 3 ? ": meshes of TetGen are not read" : ""));
  }
  TriangleColumns columns{.reals_before = 2};
  columns.reals = reader.next_of_header("the number of attributes", 0, 0);
  require_few_attributes(reader, columns.reals);
  columns.integers = reader.next_of_header("the number of boundary markers", 0, 0);
  if (columns.integers > 1) {
    reader.fail("expected 0 or 1 boundary markers a node, got " + std::to_string(columns.integers));
  }
  TriangleTable table = reader.read_rows(count, columns, "node");
  document.points.resize(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    document.points[3 * i] = table.reals_before[2 * i];
    document.points[3 * i + 1] = table.reals_before[2 * i + 1];
  }
  sites.columns.resize(2);
  sites.offsets = std::move(table.offsets);
  if (columns.reals > 0) {
    document.point_arrays.push_back(make_data_array("triangle:attribute", columns.reals, std::move(table.reals)));
  }
  if (columns.integers > 0) {
    document.point_arrays.push_back(make_data_array("triangle:marker", 1, std::move(table.integers)));
  }
  return table.first_number;
}

void read_elements(const TriangleFile& file, const FileWorkers& workers, std::int32_t first_node,
                   MeshDocument& document) {
  TriangleFileReader reader(file, workers);
  const std::size_t count = reader.next_of_header("the number of triangles", 0);
  TriangleColumns columns;
  columns.indices = reader.next_of_header("the number of nodes of a triangle", 0, 3);
  if (columns.indices != 3 && columns.indices != 6) {
    reader.fail("expected triangles of 3 or 6 nodes, got " + std::to_string(columns.indices) +
                (columns.indices == 4 ? ": meshes of TetGen are not read" : ""));
  }
  columns.reals = reader.next_of_header("the number of attributes", 0, 0);
  require_few_attributes(reader, columns.reals);
  columns.first_node = first_node;
  columns.last_node = first_node + static_cast<std::int64_t>(document.point_count()) - 1;
  TriangleTable table = reader.read_rows(count, columns, "triangle");
  CellList& cells = document.cells;
  cells.connectivity = std::move(table.indices);
  cells.offsets.resize(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    cells.offsets[i] = static_cast<std::int64_t>(columns.indices * i);
  }
  cells.types.assign(count, columns.indices == 3 ? cell_type::triangle : cell_type::quadratic_triangle);
  // Nodes four to six are in the middle of the edges opposite corners one to three: of 12, 20 and 01.
  for (std::size_t i = 0; columns.indices == 6 && i < count; ++i) {
    const auto middles = std::span(cells.connectivity).subspan(6 * i + 3, 3);
    std::rotate(middles.begin(), middles.end() - 1, middles.end());
  }
  for (std::size_t i = 0; i < columns.reals; ++i) {
    const bool is_last = i + 1 == columns.reals;
    document.cell_arrays.push_back(make_attribute(
        is_last ? "triangle:attribute" : "triangle:attribute_" + std::to_string(i + 1), table.reals, columns.reals, i));
  }
}

TriangleFile read_partner(const std::filesystem::path& path, const FileWorkers& workers) {
  std::filesystem::path partner = triangle_partner(path);
  std::error_code error;
  if (!std::filesystem::exists(partner, error)) {
    throw ReadError(path, "a mesh of Triangle is two files, and " + partner.filename().string() + " is not beside it");
  }
  FileBytes bytes = read_file_bytes(partner, workers);
  return {std::move(partner), std::move(bytes)};
}

}  // namespace

MeshDocument read_triangle_files(TriangleFile nodes, TriangleFile elements, const FileWorkers& workers) {
  MeshDocument document;
  NumberSites sites;
  const std::int32_t first_node = read_nodes(nodes, workers, document, sites);
  read_elements(elements, workers, first_node, document);
  document.first_point_label = first_node;
  document.original =
      std::make_shared<TriangleOriginal>(std::move(nodes.bytes), std::move(sites), std::move(elements.bytes));
  return document;
}

MeshDocument read_triangle(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  TriangleFile partner = read_partner(path, workers);
  TriangleFile given{path, std::move(bytes)};
  if (is_triangle_elements(path)) {
    return read_triangle_files(std::move(partner), std::move(given), workers);
  }
  return read_triangle_files(std::move(given), std::move(partner), workers);
}

}  // namespace trismooth

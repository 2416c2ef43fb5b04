// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/off/off_binary_reader.h"
#include "trismooth/mesh_io/off/off_header.h"
#include "trismooth/mesh_io/off/off_keyword.h"
#include "trismooth/mesh_io/off/off_plain_rows.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// The numbers that follow the coordinates or the indices on a line. No line has more than a vertex of STCNOFF.
using Row = std::array<double, 9>;

/// Rows that make an array if all are of one length.
class UniformRows {
 public:
  void add(std::span<const double> row) {
    if (rows_ == 0) {
      components_ = row.size();
    }
    ++rows_;
    uniform_ = uniform_ && row.size() == components_;
    if (uniform_) {
      values_.insert(values_.end(), row.begin(), row.end());
    } else {
      values_ = {};
    }
  }

  /// False where the rows are of different lengths.
  bool is_uniform() const { return uniform_; }

  void move_to(std::vector<DataArray>& arrays, std::string name) {
    if (uniform_ && components_ > 0) {
      arrays.push_back(make_data_array(std::move(name), components_, std::move(values_)));
    }
  }

 private:
  std::vector<double> values_;
  std::size_t rows_ = 0;
  std::size_t components_ = 0;
  bool uniform_ = true;
};

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::hash, begin_of_text(bytes)),
        workers_(workers),
        plain_rows_(bytes, workers) {}

  std::pair<MeshDocument, NumberSites> read() {
    const OffHeader header = read_off_header(scanner_, scanner_.text().size());
    keyword_ = header.keyword;
    if (header.is_binary) {
      return read_binary_off(scanner_.path(), scanner_.text(), begin_of_binary_data(), keyword_, workers_);
    }
    vertex_count_ = all_vertices_ = header.vertex_count;
    face_count_ = header.face_count;
    read_vertices();
    read_faces();
    check_rest();
    return {std::move(document_), std::move(sites_)};
  }

  MeshDocument read_rows(const OffHeader& header, std::size_t vertices, std::size_t faces) {
    keyword_ = header.keyword;
    vertex_count_ = vertices;
    face_count_ = faces;
    all_vertices_ = header.vertex_count;
    read_vertices();
    read_faces();
    if (!scanner_.at_end()) {
      scanner_.next_token("the end of the rows");
      scanner_.fail("expected the end of the rows");
    }
    return std::move(document_);
  }

 private:
  /// The data begin after the end of the line.
  std::size_t begin_of_binary_data() {
    scanner_.next_token("the word BINARY");
    if (!scanner_.at_end_of_line()) {
      scanner_.fail("expected the end of the line after BINARY, got " + quoted(scanner_.peek_token()));
    }
    scanner_.next_line();
    return scanner_.offset();
  }

  void read_vertices() {
    shared_resize(document_.points, 3 * vertex_count_, sites_.offsets, 3 * vertex_count_, workers_.workers);
    if (!read_plain_vertices()) {
      read_vertices_one_by_one();
    }
    if (has_vertex_colours_ && !keyword_.colours) {
      document_.notes.push_back("The keyword " + keyword_.text_or_default() +
                                " declares no colours; the numbers after the coordinates are read as colours.");
    }
  }

  bool read_plain_vertices() {
    const auto end = vertex_count_ == 0
                         ? std::nullopt
                         : plain_rows_.read_vertices(scanner_.offset(), vertex_count_, keyword_, document_, sites_);
    if (end) {
      scanner_.resume(end->last_number, end->offset);
      has_vertex_colours_ = find_array(document_.point_arrays, "colours") != nullptr;
    }
    return end.has_value();
  }

  void read_vertices_one_by_one() {
    std::vector<double> normals;
    std::vector<double> texture_coordinates;
    normals.reserve(keyword_.normals ? 3 * vertex_count_ : 0);
    texture_coordinates.reserve(keyword_.texture_coordinates ? 2 * vertex_count_ : 0);
    UniformRows colours;
    for (std::size_t vertex = 0; vertex < vertex_count_; ++vertex) {
      if (scanner_.at_end()) {
        scanner_.fail("expected " + std::to_string(vertex_count_) + " vertices, got " + std::to_string(vertex));
      }
      for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
        document_.points[i] = scanner_.next_double("a coordinate");
        sites_.offsets[i] = scanner_.token_offset();
      }
      const std::span<const double> extras = read_rest_of_line();
      if (!keyword_.allows_extras(extras.size())) {
        scanner_.fail("vertex " + std::to_string(vertex + 1) + " of " + std::to_string(vertex_count_) + ": " +
                      keyword_.text_or_default() + " has " + keyword_.describe_extras() +
                      " after the coordinates, got " + describe_count(extras.size()));
      }
      const OffExtras parts = keyword_.split(extras);
      if (vertex == 0) {
        has_vertex_colours_ = !parts.colour.empty();
      } else if (has_vertex_colours_ == parts.colour.empty()) {
        scanner_.fail("vertex " + std::to_string(vertex + 1) + " of " + std::to_string(vertex_count_) +
                      (has_vertex_colours_ ? ": has no colour, but" : ": has a colour, but not") +
                      " the vertices before it");
      }
      normals.insert(normals.end(), parts.normal.begin(), parts.normal.end());
      texture_coordinates.insert(texture_coordinates.end(), parts.texture.begin(), parts.texture.end());
      colours.add(parts.colour);
    }
    if (keyword_.normals) {
      document_.point_arrays.push_back(make_data_array("normals", 3, std::move(normals)));
    }
    colours.move_to(document_.point_arrays, "colours");
    if (keyword_.texture_coordinates) {
      document_.point_arrays.push_back(make_data_array("texture_coordinates", 2, std::move(texture_coordinates)));
    }
    note_unless_uniform(colours, "vertex");
  }

  void read_faces() {
    const auto end = face_count_ == 0
                         ? std::nullopt
                         : plain_rows_.read_faces(scanner_.offset(), face_count_, all_vertices_, document_);
    if (end) {
      scanner_.resume(end->last_number, end->offset);
      return;
    }
    CellList& cells = document_.cells;
    cells.offsets.reserve(face_count_ + 1);
    cells.types.reserve(face_count_);
    UniformRows colours;
    for (std::size_t face = 0; face < face_count_; ++face) {
      if (scanner_.at_end()) {
        scanner_.fail("expected " + std::to_string(face_count_) + " faces, got " + std::to_string(face));
      }
      const std::size_t degree = read_degree(face);
      if (face == 0) {
        // Most meshes have faces of one kind. An index takes two bytes at least.
        cells.connectivity.reserve(std::min(face_count_ * degree, bytes_left() / 2));
      }
      for (std::size_t corner = 0; corner < degree; ++corner) {
        cells.connectivity.push_back(read_index(face));
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
      cells.types.push_back(cell_type::of_face(degree));
      const std::span<const double> colour = read_rest_of_line();
      if (colour.size() > 4 || colour.size() == 2) {
        fail_face(face,
                  "expected 0, 1, 3 or 4 colour numbers after the vertices, got " + describe_count(colour.size()));
      }
      colours.add(colour);
    }
    colours.move_to(document_.cell_arrays, "colours");
    note_unless_uniform(colours, "face");
  }

  std::size_t read_degree(std::size_t face) {
    const std::string_view token = scanner_.next_token("the number of vertices of a face");
    const std::optional<std::int64_t> degree = parse_integer(token);
    if (!degree || *degree < 3) {
      fail_face(face, "expected its number of vertices, 3 or more, got " + quoted(token));
    }
    if (static_cast<std::uint64_t>(*degree) > bytes_left() / 2) {
      fail_face(face, "declares " + std::to_string(*degree) + " vertices, but the file has room for " +
                          std::to_string(bytes_left() / 2) + " at most");
    }
    return static_cast<std::size_t>(*degree);
  }

  std::int32_t read_index(std::size_t face) {
    const std::string_view token = scanner_.next_token("a vertex index");
    const std::optional<std::int64_t> index = parse_integer(token);
    if (!index || *index < 0 || *index >= static_cast<std::int64_t>(all_vertices_)) {
      fail_face(face, "expected a vertex index, got " + quoted(token) + "; the file has " +
                          std::to_string(all_vertices_) + " vertices, counted from 0");
    }
    return static_cast<std::int32_t>(*index);
  }

  /// The numbers up to the end of the line, one more than a row can hold at most.
  std::span<const double> read_rest_of_line() {
    std::size_t count = 0;
    while (!scanner_.at_end_of_line()) {
      if (count == row_.size()) {
        scanner_.next_token("the end of the line");
        scanner_.fail("expected the end of the line, got more numbers than OFF has for anything");
      }
      row_[count++] = scanner_.next_double("a number or the end of the line");
    }
    return std::span(row_).first(count);
  }

  /// Numbers after the last face are faces or vertices that the counts leave out.
  void check_rest() {
    if (scanner_.at_end()) {
      return;
    }
    const std::string_view token = scanner_.next_token("the end of the file");
    if (parse_number<double>(token)) {
      scanner_.fail("expected the end of the file after the declared " + std::to_string(vertex_count_) +
                    " vertices and " + std::to_string(face_count_) + " faces, got " + quoted(token));
    }
    document_.notes.emplace_back("The file goes on after its last face; what stands there is kept in OFF output only.");
  }

  void note_unless_uniform(const UniformRows& colours, const std::string& owner) {
    if (!colours.is_uniform()) {
      document_.notes.push_back("The " + owner +
                                " colours have different numbers of components; they are kept in OFF "
                                "output only.");
    }
  }

  static std::string describe_count(std::size_t count) { return count == 0 ? "none" : std::to_string(count); }

  [[noreturn]] void fail_face(std::size_t face, const std::string& message) const {
    scanner_.fail("face " + std::to_string(face + 1) + " of " + std::to_string(face_count_) + ": " + message);
  }

  std::size_t bytes_left() const { return scanner_.text().size() - scanner_.offset(); }

  TextScanner scanner_;
  FileWorkers workers_;
  OffPlainRows plain_rows_;
  OffKeyword keyword_;
  bool has_vertex_colours_ = false;
  MeshDocument document_;
  NumberSites sites_;
  std::size_t vertex_count_ = 0;  ///< to be read
  std::size_t face_count_ = 0;
  std::size_t all_vertices_ = 0;  ///< of the file
  Row row_{};
};

}  // namespace

MeshDocument read_off_rows(const std::filesystem::path& path, std::string_view rows, const OffHeader& header,
                           std::size_t vertices, std::size_t faces, const FileWorkers& workers) {
  return OffReader(rows, path, workers).read_rows(header, vertices, faces);
}

MeshDocument read_off(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  auto [document, sites] = OffReader(bytes, path, workers).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth

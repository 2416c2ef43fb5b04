// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mfem/mfem_reader.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/mfem/mfem_geometry.h"
#include "trismooth/mesh_io/mfem/mfem_nodes.h"
#include "trismooth/mesh_io/mfem/mfem_sets.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/careful_numbers.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::int64_t most_indices = std::numeric_limits<std::int32_t>::max();

class MfemReader {
 public:
  MfemReader(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::hash, begin_of_text(bytes)),
        workers_(workers),
        rows_(bytes, workers) {}

  /// Nothing where an element has a vertex that there is not, and elements were read in parts: read one by one, their
  /// lines are known.
  std::optional<MeshDocument> read() {
    read_version();
    bool ended = false;
    while (!ended && !scanner_.at_end()) {
      ended = read_section(scanner_.next_token("a section"));
    }
    if (!ended && has_end_ && scanner_.at_end()) {
      scanner_.fail("expected the end of the mesh, 'mfem_mesh_end', got the end of the file");
    }
    if (!has_vertices_) {
      scanner_.fail("expected the section 'vertices', got the end of the file");
    }
    if (has_bad_index()) {
      if (highest_is_of_part_) {
        return std::nullopt;
      }
      fail_index();
    }
    name_mfem_attributes(sets_, attributes_, MemberBudget(scanner_.path(), scanner_.text().size()), document_);
    return std::move(document_);
  }

  /// Where the coordinates are, of what was read.
  std::vector<NumberSites> take_sites() { return std::move(sites_); }

 private:
  void read_version() {
    const std::string_view line = trimmed(scanner_.next_line());
    constexpr std::array<std::string_view, 4> versions{"MFEM mesh v1.0", "MFEM mesh v1.1", "MFEM mesh v1.2",
                                                       "MFEM mesh v1.3"};
    if (std::ranges::find(versions, line) != versions.end()) {
      has_end_ = line != versions.front();
      return;
    }
    if (line.starts_with("MFEM NURBS mesh")) {
      scanner_.fail_at(0, "is a NURBS mesh of MFEM; only meshes of straight elements are read");
    }
    if (line.starts_with("MFEM NC mesh")) {
      scanner_.fail_at(0, "is a non-conforming mesh of MFEM; its hanging vertices must not move by themselves");
    }
    if (line.starts_with("MFEM INLINE mesh")) {
      scanner_.fail_at(0, "is an INLINE mesh of MFEM: it has no vertices; save it from MFEM as a mesh v1.0 first");
    }
    scanner_.fail_at(0, "expected 'MFEM mesh v1.0' to 'v1.3' in the first line, got " + quoted(line));
  }

  /// False as long as more may follow.
  bool read_section(std::string_view name) {
    if (name == "dimension") {
      read_dimension();
    } else if (name == "elements") {
      read_elements("elements", has_elements_);
    } else if (name == "boundary") {
      read_elements("boundary", has_boundary_);
    } else if (name == "attribute_sets") {
      read_sets(dimension_);
    } else if (name == "bdr_attribute_sets") {
      read_sets(dimension_ - 1);
    } else if (name == "vertices") {
      read_vertices();
    } else if (name == "nodes") {
      return !read_nodes();
    } else if (name == "vertex_parents" || name == "coarse_elements" || name == "root_state") {
      scanner_.fail("is a non-conforming mesh of MFEM; its hanging vertices must not move by themselves");
    } else if (name == "mfem_mesh_end" || name == "mfem_serial_mesh_end") {
      // Pieces of parallel meshes go on with what ranks exchange; all of it stays as it is.
      return true;
    } else {
      scanner_.fail("expected a section of MFEM, got " + quoted(name));
    }
    return false;
  }

  void read_dimension() { dimension_ = static_cast<int>(scanner_.next_integer("the dimension", 1, 3)); }

  void read_elements(std::string_view section, bool& seen) {
    if (seen) {
      scanner_.fail("the section " + quoted(section) + " comes twice");
    }
    seen = true;
    if (has_nodes_) {
      scanner_.fail("expected the section " + quoted(section) + " before 'nodes', which are at its elements");
    }
    if (dimension_ == 0) {
      scanner_.fail("expected the section 'dimension' before " + quoted(section));
    }
    const auto count = static_cast<std::size_t>(scanner_.next_integer("the number of elements", 0, most_indices));
    constexpr std::size_t least_numbers = 3;  // an attribute, a geometry, a vertex
    require_room(scanner_.path(), "elements", count, 2 * least_numbers, bytes_left() + 1);
    if (count == 0 || read_plain_elements(count)) {
      return;
    }
    CellList& cells = document_.cells;
    for (std::size_t element = 0; element < count; ++element) {
      if (scanner_.at_end()) {
        scanner_.fail("expected " + std::to_string(count) + " " + std::string(section) + ", got " +
                      std::to_string(element));
      }
      attributes_.push_back(static_cast<std::int32_t>(
          scanner_.next_integer("an attribute", std::numeric_limits<std::int32_t>::min(), most_indices)));
      const auto geometry = static_cast<std::size_t>(
          scanner_.next_integer("a geometry from 0 to 7", 0, static_cast<std::int64_t>(mfem_geometries.size()) - 1));
      const auto& [type, vertices] = mfem_geometries[geometry];
      for (std::size_t i = 0; i < vertices; ++i) {
        const std::int64_t index = scanner_.next_integer("a vertex, counted from 0", 0, most_indices - 1);
        note_index(index, scanner_.token_offset(), false);
        cells.connectivity.push_back(static_cast<std::int32_t>(index));
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
      cells.types.push_back(type);
    }
  }

  /// Elements that are all like the first one.
  bool read_plain_elements(std::size_t count) {
    PlainNumbers first_row(scanner_.text(), scanner_.offset());
    std::int32_t attribute = 0;
    std::size_t geometry = 0;
    if (!first_row.next(attribute) || !first_row.next(geometry) || geometry >= mfem_geometries.size()) {
      return false;
    }
    const std::uint8_t type = mfem_geometries[geometry].cell;
    const std::size_t vertices = mfem_geometries[geometry].vertices;
    if (count > (bytes_left() + 1) / 2 / (2 + vertices)) {
      return false;
    }
    CellList& cells = document_.cells;
    const std::size_t begin = cells.size();
    const std::size_t corner = cells.connectivity.size();
    shared_resize(cells.connectivity, corner + vertices * count, cells.offsets, begin + count + 1, workers_.workers);
    shared_resize(cells.types, begin + count, attributes_, begin + count, workers_.workers);
    std::atomic<std::int32_t> highest = -1;
    const auto end = rows_.read(
        scanner_.offset(), count, 2 + vertices, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
          std::int32_t highest_here = -1;
          bool plain = true;
          for (std::size_t element = first; element < last && plain; ++element) {
            std::size_t kind = 0;
            plain = numbers.next(attributes_[begin + element]) && numbers.next(kind) && kind == geometry;
            for (std::size_t i = corner + vertices * element; i < corner + vertices * (element + 1) && plain; ++i) {
              std::int32_t& index = cells.connectivity[i];
              plain = numbers.next(index) && index >= 0 && index < most_indices;
              highest_here = std::max(highest_here, index);
            }
            cells.offsets[begin + element + 1] = static_cast<std::int64_t>(corner + vertices * (element + 1));
            cells.types[begin + element] = type;
          }
          std::int32_t known = highest;
          while (highest_here > known && !highest.compare_exchange_weak(known, highest_here)) {
          }
          return plain;
        });
    if (!end) {
      cells.connectivity.resize(corner);
      cells.offsets.resize(begin + 1);
      cells.types.resize(begin);
      attributes_.resize(begin);
      return false;
    }
    note_index(highest, scanner_.offset(), true);
    scanner_.resume(end->last_number, end->offset);
    return true;
  }

  /// "name" number-of-attributes attribute ...
  void read_sets(int dimension) {
    const std::int64_t count = scanner_.next_integer("the number of sets", 0, most_indices);
    for (std::int64_t i = 0; i < count; ++i) {
      MfemSet set{read_name(), dimension, {}};
      const std::int64_t size = scanner_.next_integer("the number of attributes of a set", 0, most_indices);
      for (std::int64_t k = 0; k < size; ++k) {
        set.attributes.push_back(
            scanner_.next_integer("an attribute", std::numeric_limits<std::int32_t>::min(), most_indices));
      }
      sets_.push_back(std::move(set));
    }
  }

  /// In quotation marks where it has blanks.
  std::string read_name() {
    if (!scanner_.peek_token().starts_with('"')) {
      return std::string(scanner_.next_token("the name of a set"));
    }
    scanner_.next_token("the name of a set");
    const std::size_t begin = scanner_.token_offset() + 1;
    const std::size_t end = scanner_.text().find('"', begin);
    if (end == std::string_view::npos) {
      scanner_.fail("expected the end of the name of a set, '\"'");
    }
    scanner_.seek(end + 1);
    return std::string(scanner_.text().substr(begin, end - begin));
  }

  void read_vertices() {
    if (has_vertices_) {
      scanner_.fail("the section 'vertices' comes twice");
    }
    has_vertices_ = true;
    vertex_count_ = static_cast<std::size_t>(scanner_.next_integer("the number of vertices", 0, most_indices));
    if (scanner_.peek_token() == "nodes") {
      return;
    }
    axes_ = static_cast<std::size_t>(scanner_.next_integer("the number of coordinates of a vertex", 1, 3));
    require_room(scanner_.path(), "vertices", vertex_count_, 2 * axes_, bytes_left() + 1);
    NumberSites& sites = sites_.emplace_back();
    sites.columns.resize(axes_);
    shared_resize(document_.points, 3 * vertex_count_, sites.offsets, axes_ * vertex_count_, workers_.workers);
    read_places(sites, document_.points, "vertices");
  }

  /// The places as a grid function of MFEM. False, and nothing is read, where an element has a vertex that there is
  /// not.
  bool read_nodes() {
    if (!has_elements_ || !has_vertices_) {
      scanner_.fail("expected the sections 'elements' and 'vertices' before 'nodes'");
    }
    if (!sites_.empty()) {
      scanner_.fail("has places twice, of its vertices and in 'nodes'; save it with MFEM, which writes one of them");
    }
    has_nodes_ = true;
    if (has_bad_index()) {
      return false;
    }
    expect("FiniteElementSpace");
    expect("FiniteElementCollection:");
    const MfemNodeSpace space = mfem_node_space(scanner_.next_token("a collection of finite elements"), scanner_);
    expect("VDim:");
    axes_ = static_cast<std::size_t>(scanner_.next_integer("the number of coordinates of a place", 1, 3));
    expect("Ordering:");
    const bool by_axis = scanner_.next_integer("an ordering", 0, 1) == 0;
    require_room(scanner_.path(), "vertices", vertex_count_, 2 * axes_, bytes_left() + 1);
    const MfemNodes nodes = number_mfem_nodes(document_.cells, vertex_count_, dimension_, space, scanner_);
    require_room(scanner_.path(), "places in 'nodes'", nodes.places(), 2 * axes_, bytes_left() + 1);
    std::vector<double> places(3 * nodes.places());
    sites_.resize(by_axis ? axes_ : 1);
    for (std::size_t list = 0; list < sites_.size(); ++list) {
      NumberSites& sites = sites_[list];
      sites.columns.resize(axes_);
      if (by_axis) {
        sites.columns = {{.component = static_cast<std::uint8_t>(list)}};
      }
      sites.vertices = nodes.points_of_places;
      sites.offsets.resize(sites.columns.size() * nodes.places());
      read_places(sites, places, "places in 'nodes'");
    }
    document_.points = nodes.points_of_places.empty() ? std::move(places) : joined(places, nodes);
    return true;
  }

  void expect(std::string_view word) {
    if (const std::string_view token = scanner_.next_token(quoted(word)); token != word) {
      scanner_.fail("expected " + quoted(word) + ", got " + quoted(token));
    }
  }

  /// The place of each point, of which several elements have one each.
  std::vector<double> joined(const std::vector<double>& places, const MfemNodes& nodes) const {
    std::vector<double> points(3 * nodes.points);
    std::vector<bool> is_known(nodes.points);
    for (std::size_t place = 0; place < nodes.places(); ++place) {
      const auto point = static_cast<std::size_t>(nodes.points_of_places[place]);
      const auto from = places.begin() + static_cast<std::ptrdiff_t>(3 * place);
      const auto to = points.begin() + static_cast<std::ptrdiff_t>(3 * point);
      if (is_known[point] && !std::equal(from, from + 3, to)) {
        scanner_.fail_at(sites_.front().offset_of(place, 0),
                         (point < vertex_count_ ? "vertex " + std::to_string(point) : "the middle of an edge") +
                             " is elsewhere here than in an element before: the mesh is periodic, or torn, and what is "
                             "one in it cannot move in two places; smooth it before Mesh::MakePeriodic");
      }
      std::copy(from, from + 3, to);
      is_known[point] = true;
    }
    return points;
  }

  /// Rows of the numbers of `sites`, which has room for them, into `places`, three numbers each.
  void read_places(NumberSites& sites, std::vector<double>& places, std::string_view what) {
    const std::size_t columns = sites.columns.size();
    read_rows(rows_, scanner_, sites.size(), columns, what, [&](auto& numbers, std::size_t place) {
      for (std::size_t column = 0; column < columns; ++column) {
        if (!numbers.next_real(places[3 * place + sites.columns[column].component], "a coordinate")) {
          return false;
        }
        sites.offsets[columns * place + column] = numbers.token_offset();
      }
      return true;
    });
  }

  /// Elements stand before the vertices: whether there are so many is known later.
  void note_index(std::int64_t index, std::size_t offset, bool is_of_part) {
    if (index > highest_index_) {
      highest_index_ = index;
      highest_offset_ = offset;
      highest_is_of_part_ = is_of_part;
    }
  }

  bool has_bad_index() const { return highest_index_ >= static_cast<std::int64_t>(vertex_count_); }

  [[noreturn]] void fail_index() const {
    scanner_.fail_at(highest_offset_, "vertex " + std::to_string(highest_index_) + " is out of range: the file has " +
                                          std::to_string(vertex_count_) + " vertices, counted from 0");
  }

  std::size_t bytes_left() const { return scanner_.text().size() - scanner_.offset(); }

  TextScanner scanner_;
  FileWorkers workers_;
  PlainRows rows_;
  MeshDocument document_;
  std::vector<NumberSites> sites_;  ///< one list, or one an axis
  std::vector<std::int32_t> attributes_;
  std::vector<MfemSet> sets_;
  int dimension_ = 0;
  std::size_t vertex_count_ = 0;
  std::size_t axes_ = 0;
  bool has_end_ = false;  ///< says where it ends, as from version 1.1 on
  bool has_elements_ = false;
  bool has_boundary_ = false;
  bool has_vertices_ = false;
  bool has_nodes_ = false;
  std::int64_t highest_index_ = -1;
  std::size_t highest_offset_ = 0;
  bool highest_is_of_part_ = false;
};

}  // namespace

MeshDocument read_mfem(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  std::optional<MfemReader> reader(std::in_place, bytes, path, workers);
  std::optional<MeshDocument> document = reader->read();
  if (!document) {
    reader.emplace(bytes, path, FileWorkers(workers.workers, FileWorkers::serial));
    document = reader->read();
  }
  document->original = make_patched_original(std::move(bytes), reader->take_sites());
  return std::move(*document);
}

}  // namespace trismooth

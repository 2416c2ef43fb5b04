// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/ply/ply.h"
#include "trismooth/mesh_io/ply/ply_header.h"
#include "trismooth/mesh_io/ply/ply_plain_rows.h"
#include "trismooth/mesh_io/ply/ply_source.h"
#include "trismooth/mesh_io/ply/scalar_column.h"

namespace trismooth {

namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// Columns for the scalar properties of an element that are not in `others`.
ScalarColumns make_columns(const PlyElement& element, const std::set<std::string_view>& others) {
  ScalarColumns columns(element.properties.size());
  for (std::size_t p = 0; p < columns.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (!property.is_list() && !others.contains(property.name)) {
      columns[p].emplace(property.name, property.type, element.count);
    }
  }
  return columns;
}

void store(ScalarColumn& column, std::uint64_t row, const PlyNumber& number) {
  if (is_ply_type(column.type())) {
    column.store(row, number.value);
  } else {
    column.store_whole(row, number.whole);
  }
}

/// The cells that the rows of one element are, with the element's other properties.
struct CellBlock {
  const PlyElement* element = nullptr;
  std::uint64_t cells = 0;
  ScalarColumns columns;
  std::map<std::string_view, std::size_t> positions;  ///< of the columns, by name

  CellBlock(const PlyElement& of_cells, const std::set<std::string_view>& others)
      : element(&of_cells), cells(of_cells.count), columns(make_columns(of_cells, others)) {
    for (std::size_t p = 0; p < columns.size(); ++p) {
      if (columns[p]) {
        positions.emplace(of_cells.properties[p].name, p);
      }
    }
  }
};

std::string row_label(const PlyElement& element, std::uint64_t row) {
  const std::string name = trismooth::quoted(element.name);  // without what is not ASCII
  return name.substr(1, name.size() - 2) + " " + std::to_string(row);
}

/// Reads all that follows the header. Source is PlyTextSource or PlyBinarySource.
template <class Source>
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const PlyHeader& header, Source source, Workers& workers)
      : path_(path),
        header_(header),
        workers_(workers),
        vertex_count_(header.find("vertex")->count),
        source_(std::move(source)),
        zero_rows_left_(4 * source_.room()) {}

  /// Fills everything but the original.
  std::pair<MeshDocument, NumberSites> read() {
    require_room_for_rows();
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "edge" && element.find("vertex1") && element.find("vertex2")) {
        read_edges(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        skip_element(element);
      }
    }
    if (!source_.at_end()) {
      refuse_another_row(header_.elements.back());
      document_.notes.push_back("something follows the last row, at byte " + std::to_string(source_.offset()) +
                                ": it is not read; PLY output keeps it");
    }
    make_cell_arrays();
    return {std::move(document_), std::move(sites_)};
  }

 private:
  void require_room_for_rows() const {
    std::uint64_t room = source_.room();
    for (const PlyElement& element : header_.elements) {
      std::uint64_t least = 0;
      for (const PlyProperty& property : element.properties) {
        least += Source::least_bytes(property.count_type.value_or(property.type));
      }
      if (least > 0) {
        require_room(path_, "rows of element " + trismooth::quoted(element.name), element.count, least, room);
        room -= element.count * least;
      }
    }
  }

  /// Reads the rows of an element: on_number(row, property, value) gets the scalar properties, on_item(row, value)
  /// the items of the list property at position `list`, on_row(row) comes after each row.
  template <class OnNumber, class OnItem, class OnRow>
  void read_rows(const PlyElement& element, std::optional<std::size_t> list, OnNumber on_number, OnItem on_item,
                 OnRow on_row) {
    if (element.properties.empty()) {
      return;
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      if (source_.at_end()) {
        source_.fail("the file ends after " + std::to_string(row) + " of " + std::to_string(element.count) +
                     " rows of element " + trismooth::quoted(element.name));
      }
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (!property.is_list()) {
          on_number(row, p, source_.number(property.type, property.label));
          continue;
        }
        const std::uint64_t length = list_length(element, row, property);
        if (p != list) {
          source_.skip(property.type, length, property.label);
          continue;
        }
        for (std::uint64_t i = 0; i < length; ++i) {
          on_item(row, source_.number(property.type, property.label));
        }
      }
      on_row(row);
      if (!source_.at_row_end()) {
        source_.fail(row_label(element, row) + " has more numbers on its line than the header declares");
      }
    }
  }

  std::uint64_t list_length(const PlyElement& element, std::uint64_t row, const PlyProperty& property) {
    const PlyNumber length = source_.number(*property.count_type, property.label);
    const std::uint64_t room = source_.room() / Source::least_bytes(property.type);
    if (length.value < 0 || length.value > static_cast<double>(room)) {
      source_.fail(row_label(element, row) + " declares a list of " + length.text() +
                   " numbers, but the file has room for " + std::to_string(room) + " at most");
    }
    return static_cast<std::uint64_t>(length.whole);
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<int> site_of_property = set_sites(element);
    shared_resize(document_.points, 3 * element.count, sites_.offsets, sites_.columns.size() * element.count, workers_);
    ScalarColumns columns = make_columns(element, {axis_names.begin(), axis_names.end()});
    if (!read_plain_vertices(source_, element, site_of_property, sites_.columns.size(), document_.points,
                             sites_.offsets, columns)) {
      read_vertices_one_by_one(element, site_of_property, columns);
    }
    note_unread_lists(element, std::nullopt);
    for (auto& column : columns) {
      if (column) {
        document_.point_arrays.push_back(column->take_array());
      }
    }
  }

  void read_vertices_one_by_one(const PlyElement& element, const std::vector<int>& site_of_property,
                                ScalarColumns& columns) {
    read_rows(
        element, std::nullopt,
        [&](std::uint64_t row, std::size_t p, const PlyNumber& number) {
          const auto column = static_cast<std::size_t>(std::max(site_of_property[p], 0));
          if (site_of_property[p] >= 0) {
            sites_.offsets[sites_.columns.size() * row + column] = source_.number_offset();
          }
          if (columns[p]) {
            store(*columns[p], row, number);
            return;
          }
          if (!std::isfinite(number.value)) {
            source_.fail(row_label(element, row) + ": " + element.properties[p].name + " is not a finite " +
                         std::string(to_string(element.properties[p].type)) + " number");
          }
          document_.points[3 * row + column] = number.value;
        },
        [](std::uint64_t, const PlyNumber&) {}, [](std::uint64_t) {});
  }

  /// Gives sites to the coordinates and then to the other properties of floating point: the column of each property, or
  /// -1. x, y and z may be of different types, as where offsets along one axis are large.
  std::vector<int> set_sites(const PlyElement& element) {
    std::vector<int> site_of_property(element.properties.size(), -1);
    sites_.encoding = header_.encoding;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t property = *element.find(axis_names[axis]);
      site_of_property[property] = static_cast<int>(axis);
      sites_.column_types.push_back(element.properties[property].type);
    }
    if (std::ranges::count(sites_.column_types, sites_.column_types.front()) == 3) {
      document_.point_type = sites_.column_types.front();
    } else {
      document_.has_float32_axis = true;
    }
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (site_of_property[p] < 0 && !element.properties[p].is_list() && is_floating(element, p)) {
        site_of_property[p] = static_cast<int>(sites_.columns.size());
        sites_.columns.push_back({element.properties[p].name, 0});
        sites_.column_types.push_back(element.properties[p].type);
      }
    }
    return site_of_property;
  }

  bool is_vertex(const PlyNumber& number) const {
    return number.value >= 0 && number.value < static_cast<double>(vertex_count_);
  }

  std::int32_t vertex_index(const PlyElement& element, std::uint64_t row, const PlyNumber& number) const {
    if (!is_vertex(number)) {
      source_.fail(row_label(element, row) + ": vertex index " + number.text() + " is out of range, the file has " +
                   std::to_string(vertex_count_) + " vertices");
    }
    return static_cast<std::int32_t>(number.whole);
  }

  static bool is_index_list(const PlyProperty& property) {
    return property.is_list() && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  /// The position of the list of vertices.
  std::optional<std::size_t> find_index_list(const PlyElement& element) const {
    std::optional<std::size_t> list = element.find("vertex_indices");
    if (!list) {
      list = element.find("vertex_index");
    }
    if (element.count > 0 && (!list || !element.properties[*list].is_list() || is_floating(element, *list))) {
      throw ReadError(path_, "element " + trismooth::quoted(element.name) +
                                 " has no list of integers 'vertex_indices' or 'vertex_index'");
    }
    return list;
  }

  void read_faces(const PlyElement& element) {
    const std::optional<std::size_t> list = find_index_list(element);
    CellBlock block(element, {});
    if (element.count > 0 &&
        !PlainFaceReader(source_, element, *list, vertex_count_, document_.cells, block.columns, workers_).read()) {
      read_faces_one_by_one(element, list, block);
    }
    note_unread_lists(element, list);
    blocks_.push_back(std::move(block));
  }

  void read_faces_one_by_one(const PlyElement& element, std::optional<std::size_t> list, CellBlock& block) {
    std::vector<std::int32_t> vertices;
    read_rows(
        element, list,
        [&](std::uint64_t row, std::size_t p, const PlyNumber& number) { store(*block.columns[p], row, number); },
        [&](std::uint64_t row, const PlyNumber& number) { vertices.push_back(vertex_index(element, row, number)); },
        [&](std::uint64_t row) {
          if (vertices.size() < 3) {
            source_.fail(row_label(element, row) + " has " + std::to_string(vertices.size()) +
                         " vertices, expected 3 at least");
          }
          document_.cells.append(cell_type::of_face(vertices.size()), vertices);
          vertices.clear();
        });
  }

  void read_edges(const PlyElement& element) {
    const std::array<std::size_t, 2> ends{*element.find("vertex1"), *element.find("vertex2")};
    for (const std::size_t end : ends) {
      if (element.properties[end].is_list() || is_floating(element, end)) {
        throw ReadError(path_, element.properties[end].label + " is not an integer");
      }
    }
    CellBlock block(element, {"vertex1", "vertex2"});
    std::array<std::int32_t, 2> vertices{};
    read_rows(
        element, std::nullopt,
        [&](std::uint64_t row, std::size_t p, const PlyNumber& number) {
          if (p == ends[0] || p == ends[1]) {
            vertices[p == ends[0] ? 0 : 1] = vertex_index(element, row, number);
          } else {
            store(*block.columns[p], row, number);
          }
        },
        [](std::uint64_t, const PlyNumber&) {},
        [&](std::uint64_t) { document_.cells.append(cell_type::line, vertices); });
    note_unread_lists(element, std::nullopt);
    blocks_.push_back(std::move(block));
  }

  /// Stanford's form of a mesh: the strips one after the other in one list, -1 between two of them and at the end.
  void read_strips(const PlyElement& element) {
    const std::optional<std::size_t> list = find_index_list(element);
    std::set<std::string_view> scalars;
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list()) {
        scalars.insert(property.name);
        note_unread(property);
      }
    }
    CellBlock block(element, scalars);
    block.cells = 0;
    std::vector<std::int32_t> strip;
    const auto end_strip = [&](std::uint64_t row) {
      if (strip.empty()) {
        return;
      }
      if (strip.size() < 3) {
        source_.fail(row_label(element, row) + ": a strip has " + std::to_string(strip.size()) +
                     " vertices, expected 3 at least");
      }
      document_.cells.append(cell_type::triangle_strip, strip);
      ++block.cells;
      strip.clear();
    };
    read_rows(
        element, list, [](std::uint64_t, std::size_t, const PlyNumber&) {},
        [&](std::uint64_t row, const PlyNumber& number) {
          // Some declare the list unsigned and write -1 all the same.
          if (number.whole == -1 || (element.properties[*list].type == ScalarType::uint32 && !is_vertex(number) &&
                                     number.whole == std::numeric_limits<std::uint32_t>::max())) {
            end_strip(row);
          } else {
            strip.push_back(vertex_index(element, row, number));
          }
        },
        end_strip);
    note_unread_lists(element, list);
    blocks_.push_back(std::move(block));
  }

  /// Rows that the header leaves out would be a part of the mesh: fails where what follows the last element begins with
  /// another row of it. Rows of elements that are not read are no loss.
  void refuse_another_row(const PlyElement& element) {
    constexpr std::array<std::string_view, 4> read_elements{"vertex", "face", "edge", "tristrips"};
    if (std::ranges::count(read_elements, element.name) == 0 || element.properties.empty() || source_.at_padding() ||
        !is_row(element, source_)) {
      return;
    }
    const PlyProperty& first = element.properties.front();
    source_.skip(first.count_type.value_or(first.type), 1, first.label);
    source_.fail("expected the end of the file after the rows that the header declares, got another row of element " +
                 trismooth::quoted(element.name));
  }

  /// True where the source, a copy, stands before numbers that could be a row of the element.
  bool is_row(const PlyElement& element, Source source) const {
    try {
      for (const PlyProperty& property : element.properties) {
        const bool of_vertices = is_index_list(property);
        std::uint64_t length = 1;
        if (property.is_list()) {
          const PlyNumber declared = source.number(*property.count_type, property.label);
          length = static_cast<std::uint64_t>(declared.whole);
          if (declared.value < (of_vertices ? 3 : 0) || length > source.room()) {
            return false;
          }
        }
        for (std::uint64_t i = 0; i < length; ++i) {
          const PlyNumber number = source.number(property.type, property.label);
          if (of_vertices && element.name == "face" && !is_vertex(number)) {
            return false;
          }
        }
      }
      return true;
    } catch (const ReadError&) {
      return false;
    }
  }

  void skip_element(const PlyElement& element) {
    read_rows(
        element, std::nullopt, [](std::uint64_t, std::size_t, const PlyNumber&) {},
        [](std::uint64_t, const PlyNumber&) {}, [](std::uint64_t) {});
    if (element.count > 0) {
      document_.notes.push_back("element " + trismooth::quoted(element.name) + " is not read; PLY output keeps it");
    }
  }

  static bool is_floating(const PlyElement& element, std::size_t property) {
    const ScalarType type = element.properties[property].type;
    return type == ScalarType::float32 || type == ScalarType::float64;
  }

  void note_unread_lists(const PlyElement& element, std::optional<std::size_t> list) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (element.properties[p].is_list() && p != list) {
        note_unread(element.properties[p]);
      }
    }
  }

  void note_unread(const PlyProperty& property) {
    document_.notes.push_back((property.is_list() ? "list " : "") + property.label +
                              " is not read; PLY output keeps it");
  }

  /// A cell array needs a row for every cell: the columns of one name and type are joined, in the blocks' order, and
  /// 0 fills the rows of a block that has none.
  void make_cell_arrays() {
    std::set<std::string_view> done;
    for (const CellBlock& block : blocks_) {
      for (const auto& column : block.columns) {
        if (column && done.insert(column->name()).second) {
          make_cell_array(*column);
        }
      }
    }
  }

  void make_cell_array(const ScalarColumn& like) {
    ScalarColumn joined(like.name(), like.type(), 0);
    for (const CellBlock& block : blocks_) {
      const std::uint64_t rows = block.cells;
      const auto position = block.positions.find(like.name());
      if (position != block.positions.end() && block.columns[position->second]->type() == like.type()) {
        joined.append(*block.columns[position->second]);
      } else if (rows > zero_rows_left_) {
        document_.notes.push_back("property " + trismooth::quoted(like.name()) +
                                  " is not read: too many cells lack it; PLY output keeps it");
        return;
      } else if (rows > 0) {
        zero_rows_left_ -= rows;
        joined.append_zeros(rows);
        document_.notes.push_back("element " + trismooth::quoted(block.element->name) + " has no property " +
                                  trismooth::quoted(like.name()) + " of type " + std::string(to_string(like.type())) +
                                  ": its cells have 0 there");
      }
    }
    document_.cell_arrays.push_back(joined.take_array());
  }

  const std::filesystem::path& path_;
  const PlyHeader& header_;
  Workers& workers_;
  std::uint64_t vertex_count_;
  Source source_;
  /// A file of many properties of faces and many edges could ask for zeros out of all proportion to its size.
  std::uint64_t zero_rows_left_;
  MeshDocument document_;
  NumberSites sites_;
  std::vector<CellBlock> blocks_;
};

/// Checks that element vertex has coordinates that can be read and written back.
void check_vertex_element(const std::filesystem::path& path, const PlyHeader& header) {
  const PlyElement* const vertex = header.find("vertex");
  if (vertex == nullptr) {
    throw ReadError(path, "declares no element 'vertex'");
  }
  if (vertex->count > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) {
    throw ReadError(path, "declares " + std::to_string(vertex->count) + " vertices, more than are supported (" +
                              std::to_string(std::numeric_limits<std::int32_t>::max()) + ")");
  }
  for (const std::string_view axis : axis_names) {
    const auto position = vertex->find(axis);
    if (!position || vertex->properties[*position].is_list()) {
      throw ReadError(path, "element 'vertex' has no scalar property " + trismooth::quoted(axis));
    }
    const PlyProperty& property = vertex->properties[*position];
    if (property.type != ScalarType::float32 && property.type != ScalarType::float64) {
      throw ReadError(path, property.label + " is of the integer type " + std::string(ply_type_name(property.type)) +
                                ", which cannot hold smoothed coordinates; expected float or double");
    }
  }
}

}  // namespace

MeshDocument read_ply(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const PlyHeader header = parse_ply_header(path, bytes);
  check_vertex_element(path, header);
  auto [document, sites] =
      header.encoding == NumberEncoding::text
          ? BodyReader(path, header, PlyTextSource(path, bytes, header.size, workers), workers.workers).read()
          : BodyReader(path, header, PlyBinarySource(path, bytes, header.size, header.encoding, workers),
                       workers.workers)
                .read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth

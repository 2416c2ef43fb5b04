#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/patched_original.h"
#include "trismooth/mesh_io/ply.h"
#include "trismooth/mesh_io/ply_header.h"
#include "trismooth/mesh_io/ply_source.h"
#include "trismooth/mesh_io/scalar_column.h"

namespace trismooth {

namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// The columns that hold the scalar properties of an element, at the properties' positions; nothing where a property
/// is a list or in `others`.
using Columns = std::vector<std::optional<ScalarColumn>>;

Columns make_columns(const PlyElement& element, const std::set<std::string_view>& others) {
  Columns columns(element.properties.size());
  for (std::size_t p = 0; p < columns.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (!property.is_list() && !others.contains(property.name)) {
      columns[p].emplace(property.name, property.type, element.count);
    }
  }
  return columns;
}

/// The rows of one element that are cells, with the element's other properties.
struct CellBlock {
  const PlyElement* element = nullptr;
  Columns columns;
  std::map<std::string_view, std::size_t> positions;  ///< of the columns, by name

  CellBlock(const PlyElement& cells, const std::set<std::string_view>& others)
      : element(&cells), columns(make_columns(cells, others)) {
    for (std::size_t p = 0; p < columns.size(); ++p) {
      if (columns[p]) {
        positions.emplace(cells.properties[p].name, p);
      }
    }
  }
};

std::uint8_t face_type(std::size_t vertices) {
  return vertices == 3 ? cell_type::triangle : vertices == 4 ? cell_type::quad : cell_type::polygon;
}

std::string row_label(const PlyElement& element, std::uint64_t row) {
  return element.name + " " + std::to_string(row);
}

/// Reads all that follows the header. Source is PlyTextSource or PlyBinarySource.
template <class Source>
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const PlyHeader& header, Source source)
      : path_(path),
        header_(header),
        vertex_count_(header.find("vertex")->count),
        source_(std::move(source)),
        zero_rows_left_(4 * source_.room()) {}

  /// Fills everything but the original.
  std::pair<MeshDocument, CoordinateSites> read() {
    require_room_for_rows();
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "edge" && element.find("vertex1") && element.find("vertex2")) {
        read_edges(element);
      } else {
        skip_element(element);
      }
    }
    if (!source_.at_end()) {
      // Rows that the header leaves out would be a part of the mesh.
      source_.refuse_more_rows();
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
    const double length = source_.number(*property.count_type, property.label);
    const std::uint64_t room = source_.room() / Source::least_bytes(property.type);
    if (length < 0 || length > static_cast<double>(room)) {
      source_.fail(row_label(element, row) + " declares a list of " +
                   std::to_string(static_cast<std::int64_t>(length)) + " numbers, but the file has room for " +
                   std::to_string(room) + " at most");
    }
    return static_cast<std::uint64_t>(length);
  }

  void read_vertices(const PlyElement& element) {
    std::vector<int> axis_of_property(element.properties.size(), -1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axis_of_property[*element.find(axis_names[axis])] = static_cast<int>(axis);
    }
    document_.point_type = sites_.type = element.properties[*element.find("x")].type;
    sites_.encoding = header_.encoding;
    document_.points.resize(3 * element.count);
    sites_.offsets.resize(3 * element.count);
    Columns columns = make_columns(element, {axis_names.begin(), axis_names.end()});
    read_rows(
        element, std::nullopt,
        [&](std::uint64_t row, std::size_t p, double value) {
          if (axis_of_property[p] < 0) {
            columns[p]->store(row, value);
            return;
          }
          if (!std::isfinite(value)) {
            source_.fail(row_label(element, row) + ": " + element.properties[p].name + " is not a finite " +
                         std::string(to_string(element.properties[p].type)) + " number");
          }
          const std::size_t coordinate = 3 * row + static_cast<std::size_t>(axis_of_property[p]);
          document_.points[coordinate] = value;
          sites_.offsets[coordinate] = source_.number_offset();
        },
        [](std::uint64_t, double) {}, [](std::uint64_t) {});
    note_unread_lists(element, std::nullopt);
    for (auto& column : columns) {
      if (column) {
        document_.point_arrays.push_back(column->take_array());
      }
    }
  }

  std::int32_t vertex_index(const PlyElement& element, std::uint64_t row, double value) const {
    if (value < 0 || value >= static_cast<double>(vertex_count_)) {
      source_.fail(row_label(element, row) + ": vertex index " + std::to_string(static_cast<std::int64_t>(value)) +
                   " is out of range, the file has " + std::to_string(vertex_count_) + " vertices");
    }
    return static_cast<std::int32_t>(value);
  }

  void read_faces(const PlyElement& element) {
    std::optional<std::size_t> list = element.find("vertex_indices");
    if (!list) {
      list = element.find("vertex_index");
    }
    if (element.count > 0 && (!list || !element.properties[*list].is_list() || is_floating(element, *list))) {
      throw ReadError(path_, "element 'face' has no list of integers 'vertex_indices' or 'vertex_index'");
    }
    CellBlock block(element, {});
    std::vector<std::int32_t> vertices;
    read_rows(
        element, list, [&](std::uint64_t row, std::size_t p, double value) { block.columns[p]->store(row, value); },
        [&](std::uint64_t row, double value) { vertices.push_back(vertex_index(element, row, value)); },
        [&](std::uint64_t row) {
          if (vertices.size() < 3) {
            source_.fail(row_label(element, row) + " has " + std::to_string(vertices.size()) +
                         " vertices, expected 3 at least");
          }
          document_.cells.append(face_type(vertices.size()), vertices);
          vertices.clear();
        });
    note_unread_lists(element, list);
    blocks_.push_back(std::move(block));
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
        [&](std::uint64_t row, std::size_t p, double value) {
          if (p == ends[0] || p == ends[1]) {
            vertices[p == ends[0] ? 0 : 1] = vertex_index(element, row, value);
          } else {
            block.columns[p]->store(row, value);
          }
        },
        [](std::uint64_t, double) {}, [&](std::uint64_t) { document_.cells.append(cell_type::line, vertices); });
    note_unread_lists(element, std::nullopt);
    blocks_.push_back(std::move(block));
  }

  void skip_element(const PlyElement& element) {
    if (element.name == "tristrips" && element.count > 0) {
      throw ReadError(path_, "holds triangle strips (element 'tristrips'), which are not supported: write faces");
    }
    read_rows(
        element, std::nullopt, [](std::uint64_t, std::size_t, double) {}, [](std::uint64_t, double) {},
        [](std::uint64_t) {});
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
        document_.notes.push_back("list " + element.properties[p].label + " is not read; PLY output keeps it");
      }
    }
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
      const std::uint64_t rows = block.element->count;
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
  std::uint64_t vertex_count_;
  Source source_;
  /// A file of many properties of faces and many edges could ask for zeros out of all proportion to its size.
  std::uint64_t zero_rows_left_;
  MeshDocument document_;
  CoordinateSites sites_;
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
  std::optional<ScalarType> type;
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
    if (type.value_or(property.type) != property.type) {
      throw ReadError(path, "the properties 'x', 'y' and 'z' of element 'vertex' are of different types");
    }
    type = property.type;
  }
}

}  // namespace

MeshDocument read_ply(const std::filesystem::path& path, std::string bytes) {
  const PlyHeader header = parse_ply_header(path, bytes);
  check_vertex_element(path, header);
  auto [document, sites] =
      header.encoding == CoordinateEncoding::text
          ? BodyReader(path, header, PlyTextSource(path, bytes, header.size)).read()
          : BodyReader(path, header, PlyBinarySource(path, bytes, header.size, header.encoding)).read();
  document.original = make_patched_original(std::move(bytes), std::move(sites));
  return std::move(document);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/ply/ply.h"
#include "trismooth/mesh_io/ply/ply_header.h"

namespace trismooth {

namespace {

/// Appends the number as little-endian bytes.
template <class T>
void append_bytes(MemoryBlock& bytes, T number) {
  const T stored = in_byte_order<std::endian::little>(number);
  bytes.append(&stored, sizeof(T));
}

/// One component of an array, as a scalar property of an element.
struct WrittenProperty {
  const DataArray* array = nullptr;
  std::size_t component = 0;
  ScalarType type = ScalarType::float64;
  std::string name;
};

/// The type that holds every number of the array: its own, or for 64-bit integers a 32-bit one, if any does.
std::optional<ScalarType> written_type(const DataArray& array) {
  if (is_ply_type(array.type)) {
    return array.type;
  }
  const auto fits = [&](auto zero, auto narrow) {
    return std::ranges::all_of(array.as<decltype(zero)>(),
                               [](auto number) { return std::in_range<decltype(narrow)>(number); });
  };
  const bool is_signed = array.type == ScalarType::int64;
  if (is_signed ? fits(std::int64_t{}, std::int32_t{}) : fits(std::uint64_t{}, std::int32_t{})) {
    return ScalarType::int32;
  }
  if (is_signed ? fits(std::int64_t{}, std::uint32_t{}) : fits(std::uint64_t{}, std::uint32_t{})) {
    return ScalarType::uint32;
  }
  return std::nullopt;
}

/// The name as a PLY header can state it.
std::string header_name(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c <= ' ' || c == 0x7f; }, '_');
  return name.empty() ? "_" : name;
}

/// The properties of the arrays that PLY can hold; `used` are names that they must not take.
std::vector<WrittenProperty> written_properties(const std::vector<DataArray>& arrays,
                                                std::initializer_list<std::string_view> used) {
  FreeNames names;
  for (const std::string_view name : used) {
    names.take(name);
  }
  std::vector<WrittenProperty> properties;
  for (const DataArray& array : arrays) {
    const auto type = written_type(array);
    for (std::size_t c = 0; type && c < array.components; ++c) {
      const std::string name = array.components == 1 ? array.name : array.name + "_" + std::to_string(c);
      properties.push_back({&array, c, *type, names.claim(header_name(name))});
    }
  }
  return properties;
}

std::vector<WrittenProperty> point_properties(const MeshDocument& document) {
  return written_properties(document.point_arrays, {"x", "y", "z"});
}

std::vector<WrittenProperty> cell_properties(const MeshDocument& document) {
  return written_properties(document.cell_arrays, {"vertex_indices", "vertex_index", "vertex1", "vertex2"});
}

void append_row(MemoryBlock& bytes, std::span<const WrittenProperty> properties, std::size_t row) {
  for (const WrittenProperty& property : properties) {
    const DataArray& array = *property.array;
    visit_scalar_type(array.type, [&](auto number) {
      std::memcpy(&number, array.bytes.data() + (row * array.components + property.component) * sizeof(number),
                  sizeof(number));
      visit_scalar_type(property.type,
                        [&](auto written) { append_bytes(bytes, static_cast<decltype(written)>(number)); });
    });
  }
}

constexpr std::array<std::uint8_t, 4> ply_cell_types{cell_type::triangle, cell_type::quad, cell_type::polygon,
                                                     cell_type::line};

bool is_ply_face(std::uint8_t type) {
  return type != cell_type::line && std::ranges::count(ply_cell_types, type) > 0;
}

/// The cells that PLY holds, in the order of their elements.
struct WrittenCells {
  std::vector<std::size_t> faces;
  std::vector<std::size_t> lines;
  std::size_t longest_face = 0;
  bool reordered = false;  ///< a face stands behind a line in the document

  explicit WrittenCells(const CellList& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (is_ply_face(cells.types[c])) {
        reordered = reordered || !lines.empty();
        longest_face = std::max(longest_face, cells[c].size());
        faces.push_back(c);
      } else if (cells.types[c] == cell_type::line) {
        lines.push_back(c);
      }
    }
  }

  bool has_long_faces() const { return longest_face > std::numeric_limits<std::uint8_t>::max(); }
};

std::string make_header(const MeshDocument& document, const WrittenCells& cells) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  const auto add_element = [&](std::string_view name, std::size_t count) {
    header.append("element ").append(name).append(" ").append(std::to_string(count)).append("\n");
  };
  const auto add_property = [&](std::string_view type, std::string_view name) {
    header.append("property ").append(type).append(" ").append(name).append("\n");
  };
  const auto add_properties = [&](std::span<const WrittenProperty> properties) {
    for (const WrittenProperty& property : properties) {
      add_property(ply_type_name(property.type), property.name);
    }
  };
  add_element("vertex", document.point_count());
  for (const std::string_view axis : {"x", "y", "z"}) {
    add_property(ply_type_name(document.point_type), axis);
  }
  add_properties(point_properties(document));
  add_element("face", cells.faces.size());
  add_property(cells.has_long_faces() ? "list int int" : "list uchar int", "vertex_indices");
  add_properties(cell_properties(document));
  if (!cells.lines.empty()) {
    add_element("edge", cells.lines.size());
    add_property("int", "vertex1");
    add_property("int", "vertex2");
    add_properties(cell_properties(document));
  }
  return header + "end_header\n";
}

std::size_t row_bytes(std::size_t own, std::span<const WrittenProperty> properties) {
  for (const WrittenProperty& property : properties) {
    own += size_of(property.type);
  }
  return own;
}

void write_points(OrderedBlocks& blocks, const MeshDocument& document) {
  const std::vector<WrittenProperty> properties = point_properties(document);
  const std::size_t bytes_each = row_bytes(3 * size_of(document.point_type), properties);
  blocks.write_rows(document.point_count(), bytes_each, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
    for (std::size_t v = begin; v < end; ++v) {
      for (const double coordinate : std::span(document.points).subspan(3 * v, 3)) {
        if (document.point_type == ScalarType::float32) {
          append_bytes(bytes, static_cast<float>(coordinate));
        } else {
          append_bytes(bytes, coordinate);
        }
      }
      append_row(bytes, properties, v);
    }
  });
}

void write_cells(OrderedBlocks& blocks, const MeshDocument& document, const WrittenCells& cells) {
  const std::vector<WrittenProperty> properties = cell_properties(document);
  const std::size_t bytes_each = row_bytes(1 + 3 * sizeof(std::int32_t), properties);
  const auto append_cell = [&](MemoryBlock& bytes, std::size_t cell) {
    for (const std::int32_t vertex : document.cells[cell]) {
      append_bytes(bytes, vertex);
    }
    append_row(bytes, properties, cell);
  };
  blocks.write_rows(cells.faces.size(), bytes_each, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
    for (const std::size_t face : std::span(cells.faces).subspan(begin, end - begin)) {
      if (cells.has_long_faces()) {
        append_bytes(bytes, static_cast<std::int32_t>(document.cells[face].size()));
      } else {
        append_bytes(bytes, static_cast<std::uint8_t>(document.cells[face].size()));
      }
      append_cell(bytes, face);
    }
  });
  blocks.write_rows(cells.lines.size(), bytes_each, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
    for (const std::size_t line : std::span(cells.lines).subspan(begin, end - begin)) {
      append_cell(bytes, line);
    }
  });
}

/// Says which arrays are not in `properties` and which are there in another form.
void describe_arrays(std::vector<std::string>& lost, std::string_view kind, const std::vector<DataArray>& arrays,
                     std::span<const WrittenProperty> properties) {
  auto next = properties.begin();
  for (const DataArray& array : arrays) {
    const std::string label = std::string(kind) + " array '" + array.name + "'";
    // They come in the order of their arrays.
    const auto first = next;
    next = std::find_if(first, properties.end(), [&](const WrittenProperty& p) { return p.array != &array; });
    if (first == next) {
      lost.push_back("PLY holds no numbers of 64-bit integer types: " + label + " is not written");
      continue;
    }
    if (first->type != array.type) {
      lost.push_back("PLY holds no numbers of 64-bit integer types: " + label + " is written as " +
                     std::string(to_string(first->type)));
    }
    if (array.components > 1) {
      lost.push_back("PLY holds one number a property: " + label + " is written as '" + first->name + "' to '" +
                     std::prev(next)->name + "'");
    } else if (first->name != array.name) {
      lost.push_back("PLY cannot have a property of that name there: " + label + " is written as '" + first->name +
                     "'");
    }
  }
}

}  // namespace

void write_ply(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const WrittenCells cells(document.cells);
  BufferedWriter writer(path);
  OrderedBlocks blocks([&writer](std::string_view block) { writer.write(block); }, workers);
  blocks.write(make_header(document, cells));
  write_points(blocks, document);
  write_cells(blocks, document, cells);
  writer.close();
}

std::vector<std::string> what_ply_loses(const MeshDocument& document) {
  std::vector<std::string> lost;
  const WrittenCells cells(document.cells);
  if (const std::string others = describe_other_cells(document.cells, ply_cell_types); !others.empty()) {
    lost.push_back("PLY holds triangles, quads, polygons and lines only: not written are " + others);
  }
  if (cells.reordered) {
    lost.emplace_back("PLY lists lines apart from faces: the cells are written in another order");
  }
  describe_arrays(lost, "point", document.point_arrays, point_properties(document));
  describe_arrays(lost, "cell", document.cell_arrays, cell_properties(document));
  for (const DataArray& array : document.field_arrays) {
    lost.push_back("PLY holds arrays of points and cells only: field array '" + array.name + "' is not written");
  }
  return lost;
}

}  // namespace trismooth

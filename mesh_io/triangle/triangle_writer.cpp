// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/triangle/triangle_writer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/triangle/triangle_files.h"

namespace trismooth {

namespace {

constexpr const char* attribute_name = "triangle:attribute";
constexpr const char* marker_name = "triangle:marker";

/// Triangle's elements are of one type.
std::uint8_t written_type(const MeshDocument& document) {
  const auto& types = document.cells.types;
  const bool has_triangles = std::ranges::find(types, cell_type::triangle) != types.end();
  const bool has_quadratic = std::ranges::find(types, cell_type::quadratic_triangle) != types.end();
  return has_quadratic && !has_triangles ? cell_type::quadratic_triangle : cell_type::triangle;
}

const DataArray* real_array(std::span<const DataArray> arrays, const char* name) {
  const DataArray* const array = find_array(arrays, name);
  return array != nullptr && array->type == ScalarType::float64 ? array : nullptr;
}

const DataArray* markers_of(const MeshDocument& document) {
  const DataArray* const array = find_array(document.point_arrays, marker_name);
  return array != nullptr && array->type == ScalarType::int32 && array->components == 1 ? array : nullptr;
}

/// What the elements' attribute is from.
struct ElementAttribute {
  CellGroups groups;
  const DataArray* array = nullptr;  ///< of real numbers, where there are no groups of faces

  bool has_groups() const {
    return std::ranges::any_of(groups.groups, [](const CellGroup& group) { return group.dimension == 2; });
  }
  std::string array_name() const {
    return has_groups() ? groups.arrays.of_dimension[2] : array != nullptr ? array->name : "";
  }
  bool empty() const { return !has_groups() && array == nullptr; }
};

ElementAttribute attribute_of(const MeshDocument& document) {
  ElementAttribute attribute{find_cell_groups(document)};
  const DataArray* const array = real_array(document.cell_arrays, attribute_name);
  if (!attribute.has_groups() && array != nullptr && array->components == 1) {
    attribute.array = array;
  }
  return attribute;
}

void write_nodes(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const DataArray* const attributes = real_array(document.point_arrays, attribute_name);
  const DataArray* const markers = markers_of(document);
  const std::size_t components = attributes == nullptr ? 0 : attributes->components;
  TextMeshWriter writer(path, workers);
  writer.write_line([&](TextLines& line) {
    line.number(document.point_count()).number(2).number(components).number(markers == nullptr ? 0 : 1);
  });
  writer.write_lines(document.point_count(), [&](TextLines& lines, std::size_t i) {
    lines.number(i + 1).number(document.points[3 * i]).number(document.points[3 * i + 1]);
    for (std::size_t component = 0; component < components; ++component) {
      lines.number(attributes->value(i, component));
    }
    if (markers != nullptr) {
      lines.number(markers->as<std::int32_t>()[i]);
    }
    lines.end_line();
  });
  writer.close();
}

void write_elements(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  // Nodes four to six are opposite corners one to three.
  constexpr std::array<std::size_t, 6> order{0, 1, 2, 4, 5, 3};
  const CellList& cells = document.cells;
  const std::uint8_t type = written_type(document);
  const std::size_t nodes = type == cell_type::triangle ? 3 : 6;
  const ElementAttribute attribute = attribute_of(document);
  std::vector<std::size_t> written;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.types[cell] == type) {
      written.push_back(cell);
    }
  }
  TextMeshWriter writer(path, workers);
  writer.write_line(
      [&](TextLines& line) { line.number(written.size()).number(nodes).number(attribute.empty() ? 0 : 1); });
  writer.write_lines(written.size(), [&](TextLines& lines, std::size_t i) {
    const std::size_t cell = written[i];
    lines.number(i + 1);
    for (std::size_t node = 0; node < nodes; ++node) {
      lines.number(std::int64_t{cells[cell][order.at(node)]} + 1);
    }
    if (attribute.array != nullptr) {
      lines.number(attribute.array->value(cell));
    } else if (!attribute.empty()) {
      const std::int32_t group = attribute.groups.of_cell[cell];
      lines.number(group < 0 ? std::int64_t{0} : attribute.groups.groups[static_cast<std::size_t>(group)].number);
    }
    lines.end_line();
  });
  writer.close();
}

}  // namespace

void write_triangle(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  require_flat_points(path, "Triangle", document);
  if (is_triangle_elements(path)) {
    write_elements(path, document, workers);
  } else {
    write_nodes(path, document, workers);
  }
}

std::vector<std::string> lost_in_triangle(const MeshDocument& document) {
  const ElementAttribute attribute = attribute_of(document);
  const std::array types{written_type(document)};
  std::vector<std::string> sentences = describe_lost_z("Triangle", document);
  std::ranges::move(
      describe_lost_cells("Triangle", types[0] == cell_type::triangle ? "triangles" : "quadratic triangles", types,
                          document.cells),
      std::back_inserter(sentences));
  MeshDocument arrays;
  arrays.field_arrays = document.field_arrays;
  std::ranges::copy_if(document.point_arrays, std::back_inserter(arrays.point_arrays), [&](const DataArray& array) {
    return &array != real_array(document.point_arrays, attribute_name) && &array != markers_of(document);
  });
  std::ranges::copy_if(document.cell_arrays, std::back_inserter(arrays.cell_arrays),
                       [&](const DataArray& array) { return array.name != attribute.array_name(); });
  std::ranges::move(describe_lost_arrays("Triangle", arrays), std::back_inserter(sentences));
  if (attribute.has_groups()) {
    arrays.cell_arrays.clear();
    std::ranges::copy_if(document.cell_arrays, std::back_inserter(arrays.cell_arrays),
                         [&](const DataArray& array) { return array.name == attribute.array_name(); });
    std::ranges::move(describe_lost_names("Triangle", arrays), std::back_inserter(sentences));
  }
  std::ranges::move(describe_lost_sets("Triangle", document), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth

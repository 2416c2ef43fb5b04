// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_text.h"

namespace trismooth {

namespace {

/// Indices of points and cells are 32 bits wide in a mesh.
constexpr std::uint64_t most_points = std::numeric_limits<std::int32_t>::max();

/// VTK counts components as int; no array has that many.
constexpr std::uint64_t most_components = 1'000'000;

std::uint64_t count_attribute(const std::filesystem::path& path, const XmlElement& piece, const std::string& attribute,
                              bool required) {
  const std::optional<std::uint64_t> count = whole_number_attribute(path, piece, attribute);
  if (!count && required) {
    throw ReadError(path, piece.line, "<" + piece.name + "> has no " + attribute);
  }
  if (count > most_points) {
    throw ReadError(path, piece.line,
                    attribute + " is " + std::to_string(*count) + ", more than " + std::to_string(most_points));
  }
  return count.value_or(0);
}

bool is_array(const XmlElement& element) {
  return element.name == "DataArray" || element.name == "Array";
}

VtkXmlPiece read_piece(const std::filesystem::path& path, const XmlElement& element, VtkXmlKind kind) {
  VtkXmlPiece piece;
  piece.element = &element;
  piece.points = count_attribute(path, element, "NumberOfPoints", true);
  if (kind == VtkXmlKind::unstructured_grid) {
    piece.cells = count_attribute(path, element, "NumberOfCells", true);
    return piece;
  }
  for (std::size_t group = 0; group < poly_data_groups; ++group) {
    const std::string attribute = "NumberOf" + std::string(to_string(static_cast<PolyDataGroup>(group)));
    piece.groups[group] = count_attribute(path, element, attribute, false);
    piece.cells += piece.groups[group];
  }
  return piece;
}

/// Whatever of a section is no array.
void report_other_children(const XmlElement& section, std::vector<std::string>& losses) {
  for (const XmlElement& child : section.children) {
    if (!is_array(child)) {
      losses.push_back("<" + child.name + "> in line " + std::to_string(child.line) + " is not kept");
    }
  }
}

/// The kind of data set whose cells stand in elements of that name, or nothing.
std::optional<VtkXmlKind> kind_of_cells(std::string_view name) {
  constexpr std::array<std::string_view, 4> in_poly_data{"Verts", "Lines", "Polys", "Strips"};
  if (std::ranges::find(in_poly_data, name) != in_poly_data.end()) {
    return VtkXmlKind::poly_data;
  }
  return name == "Cells" ? std::optional(VtkXmlKind::unstructured_grid) : std::nullopt;
}

/// They would be lost without their cells.
void refuse_cells_of_other_kind(const std::filesystem::path& path, const XmlElement& piece, VtkXmlKind kind) {
  for (const XmlElement& child : piece.children) {
    if (const auto of_cells = kind_of_cells(child.name); of_cells && *of_cells != kind) {
      const std::string_view other = to_string(*of_cells);
      std::string fault = "<" + child.name + "> is of files of type ";
      fault.append(other).append(", and this one says that it is of type ").append(to_string(kind));
      fault.append("; write ").append(other).append(" there if that is what it is");
      throw ReadError(path, child.line, fault);
    }
  }
}

bool is_known_in_piece(std::string_view name, VtkXmlKind kind) {
  constexpr std::array<std::string_view, 3> always{"PointData", "CellData", "Points"};
  return std::ranges::find(always, name) != always.end() || kind_of_cells(name) == kind;
}

}  // namespace

void refuse_second(const std::filesystem::path& path, const XmlElement& parent, std::string_view name) {
  const auto is_named = [name](const XmlElement& child) { return child.name == name; };
  const auto first = std::ranges::find_if(parent.children, is_named);
  const auto second = first == parent.children.end() ? first : std::find_if(first + 1, parent.children.end(), is_named);
  if (second != parent.children.end()) {
    throw ReadError(path, second->line, "a second <" + std::string(name) + "> in <" + parent.name + ">");
  }
}

std::optional<std::uint64_t> whole_number_attribute(const std::filesystem::path& path, const XmlElement& element,
                                                    std::string_view attribute) {
  const std::string* const text = element.attribute(attribute);
  if (text == nullptr) {
    return std::nullopt;
  }
  const std::optional<std::uint64_t> number = parse_xml_count(*text);
  if (!number) {
    throw ReadError(path, element.line,
                    "expected a whole number as " + std::string(attribute) + ", got " + trismooth::quoted(*text));
  }
  return number;
}

std::vector<VtkXmlPiece> find_vtk_xml_pieces(const std::filesystem::path& path, const XmlElement& data_set,
                                             VtkXmlKind kind, std::vector<std::string>& losses) {
  if (data_set.attribute("TimeValues") != nullptr) {
    throw ReadError(path, data_set.line, "holds time steps; give a file of one mesh");
  }
  std::vector<VtkXmlPiece> pieces;
  refuse_second(path, data_set, "FieldData");
  for (const XmlElement& child : data_set.children) {
    if (child.name == "FieldData") {
      report_other_children(child, losses);
    } else if (child.name == "Piece") {
      pieces.push_back(read_piece(path, child, kind));
    } else if (!is_known_in_piece(child.name, kind)) {
      losses.push_back("<" + child.name + "> in line " + std::to_string(child.line) + " is not kept");
    }
  }
  if (pieces.empty()) {
    pieces.push_back(read_piece(path, data_set, kind));
  } else if (pieces.size() > 1) {
    losses.push_back("the file has " + std::to_string(pieces.size()) + " pieces; they are joined, and written as one");
  }
  std::uint64_t points = 0;
  for (const VtkXmlPiece& piece : pieces) {
    refuse_cells_of_other_kind(path, *piece.element, kind);
    points += piece.points;
    if (points > most_points) {
      throw ReadError(path, piece.element->line,
                      "the pieces have more than " + std::to_string(most_points) + " points");
    }
    for (const XmlElement& child : piece.element->children) {
      if (is_known_in_piece(child.name, kind)) {
        refuse_second(path, *piece.element, child.name);
        report_other_children(child, losses);
      } else if (piece.element != &data_set) {
        losses.push_back("<" + child.name + "> in line " + std::to_string(child.line) + " is not kept");
      }
    }
  }
  return pieces;
}

VtkXmlArrayType vtk_xml_array_type_of(const std::filesystem::path& path, const XmlElement& array) {
  using enum ScalarType;
  constexpr std::array<std::pair<std::string_view, ScalarType>, 10> number_types{{{"Int8", int8},
                                                                                  {"UInt8", uint8},
                                                                                  {"Int16", int16},
                                                                                  {"UInt16", uint16},
                                                                                  {"Int32", int32},
                                                                                  {"UInt32", uint32},
                                                                                  {"Int64", int64},
                                                                                  {"UInt64", uint64},
                                                                                  {"Float32", float32},
                                                                                  {"Float64", float64}}};
  VtkXmlArrayType result;
  if (const std::string* const name = array.attribute("Name")) {
    result.name = *name;
  }
  if (array.attribute("TimeStep") != nullptr) {
    throw ReadError(path, array.line,
                    "array " + trismooth::quoted(result.name) + " holds time steps; give a file of one mesh");
  }
  const std::string_view type_name = array.word("type").value_or("");
  const auto* const found = std::ranges::find(number_types, type_name, &std::pair<std::string_view, ScalarType>::first);
  if (found != number_types.end()) {
    result.type = found->second;
  } else if (type_name == "Bit") {
    result.values = VtkXmlArrayType::Values::bits;
  } else if (type_name == "String") {
    result.values = VtkXmlArrayType::Values::strings;
  } else {
    throw ReadError(path, array.line,
                    "array " + trismooth::quoted(result.name) + " has type " + trismooth::quoted(type_name) +
                        "; known are Int8 to UInt64, Float32, Float64, Bit and String");
  }
  result.components = whole_number_attribute(path, array, "NumberOfComponents").value_or(1);
  if (result.components < 1 || result.components > most_components) {
    throw ReadError(
        path, array.line,
        "array " + trismooth::quoted(result.name) + " has " + std::to_string(result.components) + " components");
  }
  result.ids = array.word("IdType") == "1" && result.type == int64;
  return result;
}

std::vector<const XmlElement*> vtk_xml_arrays_of(const XmlElement* element) {
  std::vector<const XmlElement*> arrays;
  if (element == nullptr) {
    return arrays;
  }
  for (const XmlElement& child : element->children) {
    if (is_array(child)) {
      arrays.push_back(&child);
    }
  }
  return arrays;
}

}  // namespace trismooth

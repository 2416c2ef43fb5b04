// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_attributes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 5> of_file{"type", "version", "byte_order", "header_type", "compressor"};
constexpr std::array<std::string_view, 6> of_piece{"NumberOfPoints", "NumberOfCells", "NumberOfVerts",
                                                   "NumberOfLines",  "NumberOfPolys", "NumberOfStrips"};
constexpr std::array<std::string_view, 11> of_data{"Scalars",  "Vectors",         "Normals",           "TCoords",
                                                   "Tensors",  "GlobalIds",       "EdgeFlag",          "PedigreeIds",
                                                   "Tangents", "RationalWeights", "HigherOrderDegrees"};
// The ranges are computed anew.
constexpr std::array<std::string_view, 9> of_array{
    "type", "IdType", "Name", "NumberOfComponents", "NumberOfTuples", "format", "RangeMin", "RangeMax", "offset"};
constexpr std::array<std::string_view, 1> of_appended_data{"encoding"};

/// The attributes that VTK reads from elements of that name; nothing for elements that it does not read at all.
std::optional<Names> known_attributes(std::string_view element) {
  if (element == "Piece" || element == "UnstructuredGrid" || element == "PolyData") {
    return of_piece;
  }
  if (element == "PointData" || element == "CellData") {
    return of_data;
  }
  if (element == "DataArray" || element == "Array") {
    return of_array;
  }
  if (element == "AppendedData") {
    return of_appended_data;
  }
  constexpr std::array<std::string_view, 7> without_any{"FieldData", "Points", "Cells", "Verts",
                                                        "Lines",     "Polys",  "Strips"};
  return std::ranges::find(without_any, element) != without_any.end() ? std::optional(Names()) : std::nullopt;
}

bool is_one_of(Names names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// "ComponentName1" of an array that has a second component.
bool is_component_name(const XmlElement& array, std::string_view attribute) {
  constexpr std::string_view prefix = "ComponentName";
  if (!attribute.starts_with(prefix)) {
    return false;
  }
  const auto number = [](std::string_view text) {
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return stop == text.data() + text.size() && error == std::errc() ? std::optional(value) : std::nullopt;
  };
  const std::string* const count = array.attribute("NumberOfComponents");
  const auto component = number(attribute.substr(prefix.size()));
  return component && *component < (count == nullptr ? 1 : number(*count).value_or(0));
}

/// Lines by element and attribute.
using Unknown = std::map<std::pair<std::string, std::string>, std::vector<std::size_t>>;

void find_unknown(const XmlElement& element, Unknown& unknown) {
  const std::optional<Names> known = known_attributes(element.name);
  if (!known) {
    return;
  }
  const bool is_array = element.name == "DataArray" || element.name == "Array";
  for (const auto& [attribute, value] : element.attributes) {
    if (!is_one_of(*known, attribute) && !(is_array && is_component_name(element, attribute))) {
      unknown[{element.name, attribute}].push_back(element.line);
    }
  }
  for (const XmlElement& child : element.children) {
    find_unknown(child, unknown);
  }
}

/// "line 3", "lines 3 and 9", "lines 3, 9, 12 and 40 more".
std::string line_list(const std::vector<std::size_t>& lines) {
  constexpr std::size_t most_told = 3;
  std::string text = lines.size() == 1 ? "line " : "lines ";
  const std::size_t told = std::min(lines.size(), most_told);
  for (std::size_t i = 0; i < told; ++i) {
    const bool is_last = i + 1 == lines.size();
    text += (i == 0 ? "" : is_last ? " and " : ", ") + std::to_string(lines[i]);
  }
  return text + (told == lines.size() ? "" : " and " + std::to_string(lines.size() - told) + " more");
}

}  // namespace

std::vector<std::string> unknown_vtk_xml_attributes(const XmlElement& root) {
  Unknown unknown;
  for (const XmlElement& child : root.children) {
    find_unknown(child, unknown);
  }
  std::vector<std::string> sentences;
  sentences.reserve(unknown.size());
  for (const auto& [names, lines] : unknown) {
    sentences.push_back("the attribute " + trismooth::quoted(names.second) + " of <" + names.first + "> in " +
                        line_list(lines) + " is not kept");
  }
  return sentences;
}

XmlAttributes vtk_file_attributes(const XmlElement& root) {
  XmlAttributes attributes = root.attributes;
  for (auto& [name, value] : attributes) {
    if (is_one_of(of_file, name)) {
      value = std::string(root.word(name).value_or(value));
    }
  }
  return attributes;
}

std::string unknown_vtk_file_attributes(const XmlElement& root) {
  std::string names;
  for (const auto& [attribute, value] : root.attributes) {
    if (!is_one_of(of_file, attribute)) {
      add_to_list(names, trismooth::quoted(attribute));
    }
  }
  return names;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// The value that the attribute names among `choices`, or `fallback` where it is missing.
template <class Value, std::size_t Count>
Value choose(const std::filesystem::path& path, const XmlElement& element, std::string_view attribute, Value fallback,
             const std::array<std::pair<std::string_view, Value>, Count>& choices) {
  const std::optional<std::string_view> text = element.word(attribute);
  if (!text) {
    return fallback;
  }
  std::string known;
  for (const auto& [name, value] : choices) {
    if (*text == name) {
      return value;
    }
    add_to_list(known, name);
  }
  throw ReadError(
      path, element.line,
      "<" + element.name + "> has " + std::string(attribute) + " " + trismooth::quoted(*text) + "; known are " + known);
}

void check_version(const std::filesystem::path& path, const XmlElement& root) {
  const std::optional<std::string_view> version = root.word("version");
  if (version && !version->starts_with("0.") && !version->starts_with("1.") && !version->starts_with("2.")) {
    throw ReadError(path, root.line,
                    "file version " + trismooth::quoted(*version) + " is not known; known are 0.1 to 2.x");
  }
}

const XmlElement* first_array(const XmlElement& element) {
  if (element.name == "DataArray" || element.name == "Array") {
    return &element;
  }
  for (const XmlElement& child : element.children) {
    if (const XmlElement* const array = first_array(child)) {
      return array;
    }
  }
  return nullptr;
}

const XmlElement* first_points_array(const XmlElement& element) {
  if (element.name == "Points") {
    return first_array(element);
  }
  for (const XmlElement& child : element.children) {
    if (const XmlElement* const array = first_points_array(child)) {
      return array;
    }
  }
  return nullptr;
}

void find_appended_section(const std::filesystem::path& path, std::string_view bytes, const XmlElement& root,
                           VtkXmlHeader& header) {
  const XmlElement& element = root.children.back();
  const std::size_t mark = bytes.find_first_not_of(" \t\r\n", element.content_begin);
  if (mark == std::string_view::npos || bytes[mark] != '_') {
    throw ReadError(path, element.line, "<AppendedData> does not start with '_'");
  }
  header.appended_begin = mark + 1;
  header.appended_end = bytes.rfind("</AppendedData");
  if (header.appended_end == std::string_view::npos || header.appended_end < header.appended_begin) {
    throw ReadError(path, element.line, "<AppendedData> has no end: the file is cut off");
  }
  check_xml_tail(path, bytes, root, header.appended_end);
  using Choice = std::pair<std::string_view, bool>;
  header.encoding.appended_base64 =
      choose(path, element, "encoding", true, std::array{Choice("base64", true), Choice("raw", false)});
}

}  // namespace

std::string_view to_string(VtkXmlKind kind) {
  return kind == VtkXmlKind::unstructured_grid ? "UnstructuredGrid" : "PolyData";
}

VtkXmlMode vtk_xml_mode_of(const std::filesystem::path& path, const XmlElement& array) {
  using Choice = std::pair<std::string_view, VtkXmlMode>;
  return choose(path, array, "format", VtkXmlMode::ascii,
                std::array{Choice("ascii", VtkXmlMode::ascii), Choice("binary", VtkXmlMode::binary),
                           Choice("appended", VtkXmlMode::appended)});
}

VtkXmlHeader read_vtk_xml_header(const std::filesystem::path& path, std::string_view bytes, const XmlHead& head,
                                 VtkXmlKind kind) {
  const XmlElement& root = head.root;
  if (root.name != "VTKFile") {
    throw ReadError(path, root.line, "expected <VTKFile>, got <" + root.name + ">");
  }
  const std::optional<std::string_view> type = root.word("type");
  if (type != to_string(kind)) {
    throw ReadError(path, root.line,
                    "expected a VTKFile of type " + std::string(to_string(kind)) + ", got " +
                        (!type ? std::string("none") : trismooth::quoted(*type)));
  }
  check_version(path, root);

  VtkXmlHeader header;
  using Flag = std::pair<std::string_view, bool>;
  header.encoding.big_endian =
      choose(path, root, "byte_order", false, std::array{Flag("LittleEndian", false), Flag("BigEndian", true)});
  header.encoding.wide_block_headers =
      choose(path, root, "header_type", false, std::array{Flag("UInt32", false), Flag("UInt64", true)});
  using Compressor = std::pair<std::string_view, VtkXmlCompressor>;
  header.encoding.compressor = choose(path, root, "compressor", VtkXmlCompressor::none,
                                      std::array{Compressor("vtkZLibDataCompressor", VtkXmlCompressor::zlib),
                                                 Compressor("vtkLZ4DataCompressor", VtkXmlCompressor::lz4),
                                                 Compressor("vtkLZMADataCompressor", VtkXmlCompressor::lzma)});
  if (head.stopped) {
    find_appended_section(path, bytes, root, header);
  }
  const XmlElement* const points = first_points_array(root);
  const XmlElement* const array = points != nullptr ? points : first_array(root);
  if (array != nullptr) {
    header.encoding.mode = vtk_xml_mode_of(path, *array);
  }
  return header;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_names.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

namespace {

constexpr std::string_view xml_blanks = " \t\r\n";

/// Where the value of that attribute stands in the start tag that ends at `tag_end`. The bytes are known to be XML, and
/// the tag to have the attribute.
PieceName place_of_value(std::string_view bytes, std::size_t tag_end, std::string_view attribute) {
  // (No value holds a '<'.)
  std::size_t at = bytes.find_first_of(xml_blanks, bytes.rfind('<', tag_end - 1));
  for (;;) {
    const std::size_t name = bytes.find_first_not_of(xml_blanks, at);
    const std::size_t name_end = bytes.find_first_of(" \t\r\n=", name);
    const std::size_t quote = bytes.find_first_of("\"'", name_end);
    const std::size_t end = bytes.find(bytes[quote], quote + 1);
    if (bytes.substr(name, name_end - name) == attribute) {
      return {{}, quote + 1, end};
    }
    at = end + 1;
  }
}

FileFormat piece_format_of(const std::filesystem::path& path, const XmlElement& root) {
  if (root.name != "VTKFile") {
    throw ReadError(path, root.line, "expected <VTKFile>, got <" + root.name + ">: no file of VTK's XML formats");
  }
  const std::optional<std::string_view> type = root.word("type");
  if (type == "PUnstructuredGrid") {
    return FileFormat::vtu;
  }
  if (type == "PPolyData") {
    return FileFormat::vtp;
  }
  throw ReadError(path, root.line,
                  "holds " + (type ? "'" + std::string(*type) + "'" : "data of no type") +
                      "; meshes in pieces are PUnstructuredGrid and PPolyData");
}

}  // namespace

ParallelFile read_parallel_file(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.find('\0') != bytes.npos) {
    throw ReadError(path, "is no XML of single bytes: UTF-8 is expected");
  }
  const XmlHead head = parse_xml_head(path, bytes, "", {});
  ParallelFile file;
  file.piece_format = piece_format_of(path, head.root);
  const XmlElement* const grid =
      head.root.child(file.piece_format == FileFormat::vtu ? "PUnstructuredGrid" : "PPolyData");
  if (grid == nullptr) {
    throw ReadError(path, head.root.line, "has not the element that its type says, which names the pieces");
  }
  const std::filesystem::path own = path.lexically_normal();
  std::map<std::filesystem::path, std::size_t> lines;
  for (const XmlElement& element : grid->children) {
    if (element.name != "Piece") {
      continue;
    }
    const std::string* const source = element.attribute("Source");
    if (source == nullptr || source->empty()) {
      throw ReadError(path, element.line, "a <Piece> names no file: it needs the attribute Source");
    }
    const std::filesystem::path piece = piece_path(path, *source);
    if (piece == own) {
      throw ReadError(path, element.line, "names itself as a piece");
    }
    if (const auto [first, is_new] = lines.emplace(piece, element.line); !is_new) {
      throw ReadError(path, element.line,
                      "names the piece '" + *source + "' twice, in line " + std::to_string(first->second) + " as well");
    }
    file.pieces.push_back(place_of_value(bytes, element.content_begin, "Source"));
    file.pieces.back().source = *source;
  }
  if (file.pieces.empty()) {
    throw ReadError(path, grid->line, "names no pieces");
  }
  return file;
}

std::string with_sources(std::string_view bytes, const ParallelFile& file, std::span<const std::string> sources) {
  std::string changed;
  std::size_t at = 0;
  for (std::size_t i = 0; i < file.pieces.size(); ++i) {
    const PieceName& piece = file.pieces[i];
    changed.append(bytes.substr(at, piece.begin - at));
    // What stays is left as it is written.
    changed.append(sources[i] == piece.source ? std::string(bytes.substr(piece.begin, piece.end - piece.begin))
                                              : escape_xml_attribute(sources[i]));
    at = piece.end;
  }
  return changed.append(bytes.substr(at));
}

}  // namespace trismooth

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "input_checks.h"
#include "whole_files.h"

using accepted_files::AcceptedFile;

namespace whole_files {

namespace {

/// OFF ends with its last face, and that face may have no colour, or one of 1, 3 or 4 numbers.
bool is_whole_off(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "endian")) {
    return false;  // every byte counts
  }
  const std::string last_face = contains(file.bytes, "6 7 8") ? "6 7 8" : contains(file.bytes, "3 0 4") ? "3 0 4" : "?";
  const std::size_t end = file.bytes.rfind(last_face) + last_face.size();
  if (cut < end) {
    return false;
  }
  const std::size_t numbers =
      contains(file.name, "colours") ? words(std::string_view(file.bytes).substr(end, cut - end)).size() : 0;
  return numbers <= 4 && numbers != 2;
}

/// Where the first statement of a vertex begins.
std::size_t first_vertex_of(const AcceptedFile& file) {
  std::size_t at = file.bytes.find("v ");
  while (at > 0 && !contains("\r\n", file.bytes.substr(at - 1, 1))) {
    at = file.bytes.find("v ", at + 1);
  }
  return at;
}

/// After its first vertex OBJ has no end: it is whole after every whole statement, and statements end with any of
/// their words.
bool is_whole_obj(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(0, cut);
  for (std::size_t at = text.find("\\\n"); at != std::string::npos; at = text.find("\\\n")) {
    text.replace(at, 2, "  ");
  }
  const std::vector<std::string> last = words(std::string_view(text).substr(text.find_last_of("\r\n") + 1));
  if (contains(file.name, "faces_first") && cut + 1 < file.bytes.size()) {
    return false;  // the vertices that the faces name are not there
  }
  if (contains(file.name, "mark") && cut > 0 && cut < 3) {
    return false;  // a part of the mark
  }
  const std::size_t comments_end = std::min(file.bytes.find("mtllib"), file.bytes.find("g a"));
  if (cut <= first_vertex_of(file)) {
    // A mesh has vertices, but a file of comments is a mesh of nothing.
    return cut > 0 && comments_end != file.bytes.npos && cut <= comments_end;
  }
  if (last.empty()) {
    return true;
  }
  const std::string& keyword = last.front();
  const std::size_t count = last.size() - 1;
  if (keyword == "v") {
    return count == 3 || count == 4 || count == 6 || count == 7;
  }
  const bool has_vertices = keyword == "f" || keyword == "l" || keyword == "p";
  if (has_vertices) {
    return count >= (keyword == "f"   ? 3U
                     : keyword == "l" ? 2U
                                      : 1U) &&
           last.back().back() != '-' && last.back() != "\\";
  }
  return true;
}

/// Text ends with its last number; binary data with their last byte, unless something that is not read follows.
bool is_whole_ply(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "endian") && contains(file.name, "tail")) {
    return cut >= file.bytes.find("made for");
  }
  return contains(file.bytes, "format ascii") && cut > file.bytes.find_last_of("0123456789");
}

/// Text may end after every facet, within a line that is none of a facet too.
bool is_whole_stl(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "binary")) {
    return cut >= file.bytes.find("made for");
  }
  std::string text = file.bytes.substr(0, cut);
  std::ranges::transform(text, text.begin(), [](char c) { return 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  const std::size_t end = text.rfind("endfacet");
  if (end == text.npos) {
    return false;
  }
  const std::vector<std::string> rest = words(std::string_view(text).substr(end));
  return rest.front() == "endfacet" && std::ranges::count(rest, "facet") == 0;
}

constexpr std::string_view comment = " \t# of a test";

/// The file with blanks in place of comments.
std::string without_comments(std::string bytes) {
  for (std::size_t at = bytes.find(comment); at != bytes.npos; at = bytes.find(comment, at)) {
    bytes.replace(at, comment.size(), std::string(comment.size(), ' '));
  }
  return bytes;
}

/// After their cells, legacy files end before every attribute and within METADATA, but for the names in it. (The lines,
/// polygons and so on of a POLYDATA are attributes in this sense, but for the first.)
bool is_whole_legacy(const AcceptedFile& file, std::size_t cut) {
  const std::string bytes = without_comments(file.bytes);
  const bool binary = contains(bytes, "\nBINARY");
  const std::size_t cells_begin = bytes.find(contains(bytes, "POLYDATA") ? "\nLINES" : "\nCELL_TYPES") + 1;
  std::vector<std::size_t> starts;
  for (const std::string_view keyword : {"POLYGONS", "POINT_DATA", "CELL_DATA", "SCALARS", "LOOKUP_TABLE table 2",
                                         "VECTORS", "METADATA", "COLOR_SCALARS", "FIELD"}) {
    for (std::size_t at = bytes.find(keyword, cells_begin); at != bytes.npos; at = bytes.find(keyword, at + 1)) {
      // SCALARS stands in COLOR_SCALARS too.
      if (bytes[at - 1] == '\n') {
        starts.push_back(at);
      }
    }
  }
  starts.push_back(bytes.size());
  std::ranges::sort(starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    std::size_t end = starts[i] - 1;
    if (std::string_view(file.bytes).substr(0, end).ends_with(comment)) {
      end -= comment.size();
    }
    if (!binary) {
      while (is_space(bytes[end - 1])) {
        --end;
      }
      // A number cut is a number.
      while (!is_space(bytes[end - 2])) {
        --end;
      }
    }
    const bool metadata = i + 1 < starts.size() && bytes.compare(starts[i], 8, "METADATA") == 0;
    if ((end <= cut && cut <= starts[i]) || (metadata && starts[i] + 8 <= cut && cut < starts[i + 1])) {
      // Of the names of components there is a known number, the last of them an empty line.
      const std::size_t names = metadata ? bytes.find("COMPONENT_NAMES", starts[i]) : bytes.npos;
      return names == bytes.npos || cut < names + 15 || cut > bytes.find("\n\n", names) + 1;
    }
  }
  return false;
}

/// XML ends with the end of its root.
bool is_whole_xml(const AcceptedFile& file, std::size_t cut) {
  const std::string_view end = "</VTKFile>";
  return cut >= file.bytes.rfind(end) + end.size();
}

}  // namespace

bool is_whole_general(const AcceptedFile& file, std::size_t cut) {
  return file.extension == ".off"   ? is_whole_off(file, cut)
         : file.extension == ".obj" ? is_whole_obj(file, cut)
         : file.extension == ".ply" ? is_whole_ply(file, cut)
         : file.extension == ".stl" ? is_whole_stl(file, cut)
         : file.extension == ".vtk" ? is_whole_legacy(file, cut)
                                    : is_whole_xml(file, cut);
}

}  // namespace whole_files

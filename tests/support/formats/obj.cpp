// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/cell_list.h"

#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

/// The faces in the words of OBJ; `word` makes one of a vertex, counted from 0.
std::string obj_faces(const Mesh& all, const std::function<std::string(int)>& word) {
  std::string text;
  for (const std::vector<int>& face : all.faces) {
    text += 'f';
    for (const int vertex : face) {
      text += " " + word(vertex);
    }
    text += '\n';
  }
  return text;
}

std::string obj_vertices(const Mesh& all, std::string_view more = "") {
  std::string text;
  for (const auto& point : all.points) {
    text += fmt::format("v {}{}\n", text_of(point), more);
  }
  return text;
}

void add_obj(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"obj_" + name, ".obj", std::move(bytes)});
  };
  const Mesh triangles = mesh(false);
  const Mesh others = mesh(true);
  const auto number = [](int v) { return fmt::format("{}", v + 1); };
  const std::string plain = "# a title\nmtllib a b.mtl\no plate\n" + obj_vertices(triangles) + "g one two\ns off\n" +
                            obj_faces(triangles, number);
  add("plain", plain);
  add("polygons", obj_vertices(others) + "usemtl steel # 1\nl 1 2\nl 1 2 3\np 9\n" + obj_faces(others, number));
  add("texture_normal", obj_vertices(others) + "vt 0.5 0.25\nvn 0 0 1\n" +
                            obj_faces(others, [](int v) { return fmt::format("{}/1/1", v + 1); }));
  add("normal", obj_vertices(triangles, " 0.5 0.25 1") + "vn 0 0 1\n" +
                    obj_faces(triangles, [](int v) { return fmt::format("{}//-1", v + 1); }));
  add("relative", obj_vertices(triangles, " 1.0") + "vt 0 0\n" +
                      obj_faces(triangles, [](int v) { return fmt::format("{}/1", v - 5); }));
  add("faces_first", obj_faces(triangles, number) + obj_vertices(triangles));
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  std::string broken = obj_vertices(triangles) + obj_faces(triangles, number);
  for (std::size_t at = broken.find(" 4\n"); at != std::string::npos; at = broken.find(" 4\n", at + 5)) {
    broken.replace(at, 1, " \\\n ");
  }
  add("continued", "g a \\\n b\nv \\\n" + broken.substr(2));
  add("no_final_newline", plain.substr(0, plain.size() - 1));
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

}  // namespace

FormatSample obj_sample() {
  return {.format = trismooth::FileFormat::obj,
          .add_files = &add_obj,
          .is_whole = &is_whole_obj,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::some_cells; },
          .cells = {{cell_type::triangle, cell_type::quad, cell_type::polygon, cell_type::line, cell_type::poly_line,
                     cell_type::vertex, cell_type::poly_vertex}}};
}

}  // namespace accepted_files

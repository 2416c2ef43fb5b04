// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <sstream>
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

/// How a universal file spells the mesh.
struct UnvSpelling {
  std::function<int(int)> id = [](int vertex) { return vertex + 1; };
  std::string_view exponent = "D";
  int nodes = 2411;
  int elements = 2412;
};

std::string unv_data_set(int number, const std::string& records) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, records);
}

std::string unv_integers(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += fmt::format("{:10}", numbers[i]) + (i % 8 == 7 || i + 1 == numbers.size() ? "\n" : "");
  }
  return text;
}

std::string unv_nodes(const Mesh& mesh, const UnvSpelling& spelling) {
  std::string text;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    text += unv_integers({spelling.id(static_cast<int>(i)), 1, 1, 11});
    for (const double x : mesh.points[i]) {
      std::string number = fmt::format("{:25.16E}", x);
      text += number.replace(number.find('E'), 1, spelling.exponent);
    }
    text += '\n';
  }
  return unv_data_set(spelling.nodes, text);
}

std::string unv_element(const UnvSpelling& spelling, int label, int descriptor, const std::vector<int>& vertices) {
  std::vector<int> head{label, descriptor, 1, 0, 7, static_cast<int>(vertices.size())};
  if (spelling.elements == 780) {
    head = {label, descriptor, 1, 1, 1, 0, 7, static_cast<int>(vertices.size())};
  }
  std::vector<int> ids;
  for (const int vertex : vertices) {
    ids.push_back(spelling.id(vertex));
  }
  return unv_integers(head) + (descriptor < 30 ? unv_integers({0, 0, 0}) : "") + unv_integers(ids);
}

std::string unv_triangles(const Mesh& mesh, const UnvSpelling& spelling, const std::string& more = "") {
  std::string text;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::vector<int> face(mesh.faces[i].begin(), mesh.faces[i].end());
    text += unv_element(spelling, static_cast<int>(i) + 101, 91, face);
  }
  return unv_data_set(spelling.elements, text + more);
}

/// Of so many numbers a member.
std::string unv_group(int number, const std::string& name, const std::vector<int>& members, std::size_t each = 4) {
  return unv_integers({number, 0, 0, 0, 0, 0, 0, static_cast<int>(members.size() / each)}) + name + "\n" +
         unv_integers(members);
}

void add_unv(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"unv_" + name, ".unv", std::move(bytes)});
  };
  const Mesh plate = mesh(false);
  const auto spelled = [&plate](const UnvSpelling& spelling, const std::string& more = "") {
    return unv_nodes(plate, spelling) + unv_triangles(plate, spelling, more);
  };
  const std::string groups = unv_data_set(2467, unv_group(3, "lower half", {8, 101, 0, 0, 8, 102, 0, 0}) +
                                                    unv_group(5, "upper", {8, 103, 0, 0, 8, 104, 0, 0, 8, 102, 0, 0}) +
                                                    unv_group(9, "corner", {7, 1, 0, 0}));
  const std::string plain = spelled({}) + groups;
  add("plain", plain);
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("no_groups", spelled({.exponent = "E"}));
  add("old", spelled({.exponent = "e", .nodes = 781, .elements = 780}));
  add("elements_first", unv_triangles(plate, {}) + unv_nodes(plate, {}));
  add("sparse_ids", spelled({.id = [](int vertex) { return 1000 * (9 - vertex); }}));
  add("old_groups", spelled({}) + unv_data_set(2432, unv_group(3, "lower half", {8, 101, 8, 102, 7, 1, 8, 103}, 2)));
  add("units",
      unv_data_set(151, "a model\nNONE\n") + unv_data_set(164, "         1  SI: Meter (newton)         2\n") + plain);
  add("beams", spelled({}, unv_element({}, 7, 21, {0, 1}) + unv_element({}, 8, 11, {1, 2})));
  add("unknown_elements", spelled({}, unv_element({}, 7, 161, {4}) + unv_element({}, 8, 136, {0, 2})));
}

/// Universal files may end behind any data set; a mesh has nodes, all that its elements name.
bool is_whole_unv(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(0, cut);
  std::ranges::replace(text, '\r', '\n');
  std::istringstream lines(text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0));
  bool is_open = false;
  bool has_nodes = false;
  std::string number;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> all = words(line);
    if (all == std::vector<std::string>{"-1"}) {
      has_nodes = has_nodes || (is_open && (number == "2411" || number == "781"));
      is_open = !is_open;
      number.clear();
    } else if (is_open && number.empty() && !all.empty()) {
      number = all.front();
    } else if (!is_open && !all.empty()) {
      return false;
    }
  }
  return !is_open && has_nodes;
}

}  // namespace

FormatSample unv_sample() {
  return {.format = trismooth::FileFormat::unv,
          .add_files = &add_unv,
          .is_whole = &is_whole_unv,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::some_cells; },
          .cells = {{cell_type::line, cell_type::quadratic_edge, cell_type::triangle, cell_type::quad,
                     cell_type::quadratic_triangle, cell_type::quadratic_quad, cell_type::biquadratic_quad,
                     cell_type::tetrahedron, cell_type::wedge, cell_type::hexahedron, cell_type::quadratic_tetrahedron,
                     cell_type::quadratic_hexahedron, cell_type::quadratic_wedge}}};
}

}  // namespace accepted_files

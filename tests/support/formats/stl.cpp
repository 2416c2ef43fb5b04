// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/cell_list.h"

#include "support/accepted_vtk_files.h"
#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

std::string text_stl(int solids) {
  const Mesh all = mesh(false);
  const std::size_t each = all.faces.size() / static_cast<std::size_t>(solids);
  std::string text;
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    text += i % each == 0 ? fmt::format("solid part {}\n", i / each) : "";
    text += " facet normal 0 0 1\n  outer loop\n";
    for (const int vertex : all.faces[i]) {
      text += "   vertex " + text_of(all.points[static_cast<std::size_t>(vertex)]) + "\n";
    }
    text += "  endloop\n endfacet\n";
    text += (i + 1) % each == 0 ? fmt::format("endsolid part {}\n", i / each) : "";
  }
  return text;
}

std::string binary_stl(std::string title, bool attributes) {
  const Mesh all = mesh(false);
  title.resize(80);
  title += vtk::number_bytes(static_cast<std::uint32_t>(all.faces.size()), false);
  for (std::size_t i = 0; i < all.faces.size(); ++i) {
    std::vector<std::array<double, 3>> rows{{0, 0, 1}};
    for (const int vertex : all.faces[i]) {
      rows.push_back(all.points[static_cast<std::size_t>(vertex)]);
    }
    for (const auto& row : rows) {
      for (const double number : row) {
        title += vtk::number_bytes(static_cast<float>(number), false);
      }
    }
    title += vtk::number_bytes(static_cast<std::uint16_t>(attributes ? i : 0), false);
  }
  return title;
}

void add_stl(std::vector<AcceptedFile>& files) {
  const std::string text = text_stl(1);
  std::string upper = text;
  std::ranges::transform(upper, upper.begin(), [](char c) { return 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c; });
  files.push_back({"stl_ascii", ".stl", text});
  files.push_back({"stl_ascii_solids", ".stl", text_stl(2)});
  files.push_back({"stl_ascii_crlf", ".stl", with_line_ends(upper, "\r\n")});
  files.push_back({"stl_ascii_cr", ".stl", with_line_ends(text, "\r")});
  files.push_back({"stl_ascii_mark", ".stl", "\xEF\xBB\xBF" + text});
  files.push_back({"stl_ascii_no_end", ".stl", text.substr(0, text.find("endsolid"))});
  std::string coloured = text_stl(2);
  for (std::size_t at = coloured.find(" facet"); at != std::string::npos; at = coloured.find(" facet", at + 30)) {
    coloured.insert(at, " color 0.5 0.25 1\n");
  }
  coloured.insert(coloured.find("  endloop"), "\tMaterial brass\n");
  files.push_back({"stl_ascii_coloured", ".stl", coloured});
  files.push_back({"stl_binary_tail", ".stl", binary_stl("COLOR=", true) + "made for a test\n"});
  files.push_back({"stl_binary", ".stl", binary_stl("", false)});
  files.push_back({"stl_binary_solid", ".stl", binary_stl("solid that is none", true)});
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

}  // namespace

FormatSample stl_sample() {
  return {.format = trismooth::FileFormat::stl,
          .add_files = &add_stl,
          .is_whole = &is_whole_stl,
          .rest_of =
              [](const AcceptedFile& file) {
                return file.name.starts_with("stl_ascii") ? Rest::some_cells : Rest::all_cells;
              },
          .cells = {{cell_type::triangle}}};
}

}  // namespace accepted_files

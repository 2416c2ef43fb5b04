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

/// How an ADCIRC grid spells the mesh.
struct AdcircSpelling {
  std::string counts = "4 5\n";
  std::string_view separator = " ";
  std::string_view row_end = "\n";
  std::function<int(int)> id = [](int vertex) { return vertex + 1; };
  std::string exponent{};
};

std::string adcirc(const AdcircSpelling& spelling, std::string_view boundaries) {
  const Mesh all = mesh(false);
  std::string text = "a grid\n" + spelling.counts;
  const auto add_row = [&](const std::vector<std::string>& words) {
    text += fmt::format("{}{}", fmt::join(words, spelling.separator), spelling.row_end);
  };
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const auto& [x, y, z] = all.points[i];
    add_row({fmt::format("{}", spelling.id(static_cast<int>(i))), fmt::format("{}{}", x, spelling.exponent),
             fmt::format("{}{}", y, spelling.exponent), fmt::format("{}.5{}", i, spelling.exponent)});
  }
  int number = 0;
  for (const auto& face : all.faces) {
    std::vector<std::string> words{fmt::format("{}", ++number), fmt::format("{}", face.size())};
    for (const int vertex : face) {
      words.push_back(fmt::format("{}", spelling.id(vertex)));
    }
    add_row(words);
  }
  return text + std::string(boundaries);
}

void add_adcirc(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"adcirc_" + name, ".14", std::move(bytes)});
  };
  const std::string boundaries =
      "1 = Number of open boundaries\n2 = Total number of open boundary nodes\n2 = Number of nodes for open boundary "
      "1\n1\n2\n1 = Number of land boundaries\n4 = Total number of land boundary nodes\n4 20 = Number of nodes for "
      "land boundary 1\n2\n3\n4\n1\n";
  const std::string plain = adcirc({}, boundaries);
  add("plain", plain);
  add("no_boundaries", adcirc({}, ""));
  add("no_land", adcirc({}, "0\n0\n"));
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("no_final_newline", plain.substr(0, plain.size() - 1));
  add("commas", adcirc({.counts = " 4, 5 ! NE, NP\n", .separator = " , ", .row_end = " ! a row\n", .exponent = "D+00"},
                       "0\n0\n0\n0\n"));
  add("sparse_ids", adcirc({.id = [](int vertex) { return 1000 * (9 - vertex); }}, ""));
  add("unordered_ids", adcirc({.id = [](int vertex) { return 9 - vertex; }}, ""));
  add("weirs", adcirc({},
                      "0\n0\n3\n6\n2 3\n1 1.5 1.0\n2 1.5 1.0\n1 24 = Number of nodes for land boundary 2\n3 4 2.5 "
                      "1.0 1.0\n1 1\n5\n"));
  add("rest", adcirc({}, "0\n0\n0\n0\nmade for a test\n"));
}

/// A grid is whole behind its elements and behind each list of boundaries.
bool is_whole_adcirc(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(0, cut);
  std::ranges::replace(text, ',', ' ');
  std::ranges::replace(text, '\r', '\n');
  std::istringstream stream(text.substr(std::min(text.find('\n'), text.size())));
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(stream, line);) {
    if (std::vector<std::string> words_of_line = words(line); !words_of_line.empty()) {
      lines.push_back(std::move(words_of_line));
    }
  }
  constexpr std::size_t elements_end = 1 + 5 + 4;
  const std::size_t id_size = contains(file.name, "sparse") ? 4 : 1;
  if (lines.size() < elements_end || lines[elements_end - 1].size() < 5 ||
      lines[elements_end - 1][4].size() != id_size) {
    return false;
  }
  std::size_t at = elements_end;
  for (const std::size_t count_words : {1, 2}) {
    if (at >= lines.size()) {
      return at == lines.size();
    }
    const int count = std::stoi(lines[at][0]);
    at += 2;
    for (int boundary = 0; boundary < count; ++boundary) {
      if (at >= lines.size() || lines[at].size() < count_words) {
        return false;
      }
      const std::size_t node_words = count_words == 2 && lines[at][1] == "24" ? 2 : 1;
      for (int left = std::stoi(lines[at++][0]); left > 0; --left, ++at) {
        if (at >= lines.size() || lines[at].size() < node_words) {
          return false;
        }
      }
    }
  }
  return at <= lines.size();
}

}  // namespace

FormatSample adcirc_sample() {
  return {.format = trismooth::FileFormat::adcirc,
          .add_files = &add_adcirc,
          .is_whole = &is_whole_adcirc,
          .cells = {{cell_type::triangle}}};
}

}  // namespace accepted_files

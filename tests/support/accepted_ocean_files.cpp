#include "support/accepted_ocean_files.h"

#include <algorithm>
#include <functional>
#include <string_view>

#include <fmt/format.h>

namespace accepted_files {

namespace {

std::string with_ends(std::string_view text, std::string_view line_end) {
  std::string changed;
  for (const char c : text) {
    changed += c == '\n' ? std::string(line_end) : std::string(1, c);
  }
  return changed;
}

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
  add("crlf", with_ends(plain, "\r\n"));
  add("cr", with_ends(plain, "\r"));
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

/// How a 2dm file spells the mesh.
struct SmsSpelling {
  std::string_view separator = " ";
  std::string_view row_end = "\n";
  std::function<int(int)> id = [](int vertex) { return vertex + 1; };
  std::string exponent{};
  bool nodes_first = true;
  bool materials = true;
};

std::string sms(const SmsSpelling& spelling, std::string_view rest) {
  const Mesh all = mesh(false);
  std::string nodes;
  std::string elements;
  const auto add_row = [&](std::string& text, const std::vector<std::string>& words) {
    text += fmt::format("{}{}", fmt::join(words, spelling.separator), spelling.row_end);
  };
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const auto& [x, y, z] = all.points[i];
    add_row(nodes,
            {"ND", fmt::format("{}", spelling.id(static_cast<int>(i))), fmt::format("{}{}", x, spelling.exponent),
             fmt::format("{}{}", y, spelling.exponent), fmt::format("{}.5{}", i, spelling.exponent)});
  }
  int number = 0;
  for (const auto& face : all.faces) {
    std::vector<std::string> words{"E3T", fmt::format("{}", ++number)};
    for (const int vertex : face) {
      words.push_back(fmt::format("{}", spelling.id(vertex)));
    }
    if (spelling.materials) {
      words.emplace_back(number < 3 ? "7" : "-12");
    }
    add_row(elements, words);
  }
  return (spelling.nodes_first ? nodes + elements : elements + nodes) + std::string(rest);
}

void add_sms(std::vector<AcceptedFile>& files) {
  const auto add = [&](const std::string& name, std::string bytes) {
    files.push_back({"2dm_" + name, ".2dm", std::move(bytes)});
  };
  const std::string head = "MESH2D\nMESHNAME \"a square # 1\"\nNUM_MATERIALS_PER_ELEM 1\n";
  const std::string strings = "NS 1 2\nNS -3 12\nNS 4 -1 \"the inlet\"\n";
  const std::string plain = head + sms({}, strings + "MAT 7 \"sand # 1\"\n");
  add("plain", plain);
  add("elements_first", head + sms({.nodes_first = false}, strings));
  add("no_materials", "MESH2D\n" + sms({.materials = false}, ""));
  add("crlf", with_ends(plain, "\r\n"));
  add("cr", with_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("comments", "# a mesh\n\nMESH2D # of\n" + sms({.separator = " \t", .row_end = " # a row\n"}, ""));
  add("exponents", "MESH2D\n" + sms({.exponent = "D+00"}, "NS 1 -3\n"));
  add("sparse_ids", "MESH2D\n" + sms({.id = [](int vertex) { return 1000 * (9 - vertex); }}, "NS 9000 -7000\n"));
  add("unordered_ids", "MESH2D\n" + sms({.id = [](int vertex) { return 9 - vertex; }}, "NS 9 -7\n"));
  add("lines", "MESH2D\n" + sms({}, "E2L 5 1 2 3\nE2L 6 2 3 3\n"));
  add("other_cards", "MESH2D\nGM \"Mesh\"\n" + sms({}, "BEGPARAMDEF\nTIME 0.5\nENDPARAMDEF\n"));
  add("no_final_newline", "MESH2D\n" + sms({}, "NS 1 -4"));
}

}  // namespace

void add_ocean_files(std::vector<AcceptedFile>& files) {
  add_adcirc(files);
  add_sms(files);
}

}  // namespace accepted_files

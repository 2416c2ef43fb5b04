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
  add("crlf", with_line_ends(plain, "\r\n"));
  add("cr", with_line_ends(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("comments", "# a mesh\n\nMESH2D # of\n" + sms({.separator = " \t", .row_end = " # a row\n"}, ""));
  add("exponents", "MESH2D\n" + sms({.exponent = "D+00"}, "NS 1 -3\n"));
  add("sparse_ids", "MESH2D\n" + sms({.id = [](int vertex) { return 1000 * (9 - vertex); }}, "NS 9000 -7000\n"));
  add("unordered_ids", "MESH2D\n" + sms({.id = [](int vertex) { return 9 - vertex; }}, "NS 9 -7\n"));
  add("lines", "MESH2D\n" + sms({}, "E2L 5 1 2 3\nE2L 6 2 3 3\n"));
  add("other_cards", "MESH2D\nGM \"Mesh\"\n" + sms({}, "BEGPARAMDEF\nTIME 0.5\nENDPARAMDEF\n"));
  add("no_final_newline", "MESH2D\n" + sms({}, "NS 1 -4"));
}

/// A card of 2dm: its words; names in quotation marks with that at the beginning, and with that at the end where it is
/// there.
using SmsCard = std::vector<std::string>;

std::vector<SmsCard> cards_of(std::string text) {
  std::ranges::replace(text, '\r', '\n');
  std::istringstream lines(text);
  std::vector<SmsCard> cards;
  for (std::string line; std::getline(lines, line);) {
    SmsCard card;
    for (std::size_t at = line.find_first_not_of(" \t"); at < line.size() && line[at] != '#';
         at = line.find_first_not_of(" \t", at)) {
      const bool is_name = line[at] == '"';
      const std::size_t end = is_name ? std::min(line.find('"', at + 1), line.size() - 1) + 1
                                      : std::min(line.find_first_of(" \t#", at), line.size());
      card.push_back(line.substr(at, end - at));
      at = end;
    }
    if (!card.empty()) {
      cards.push_back(card);
    }
  }
  return cards;
}

/// Whether a name in quotation marks has no end.
bool is_open_name(const std::string& word) {
  return word[0] == '"' && (word.size() == 1 || word.back() != '"');
}

/// 2dm has no end: a text is whole where its last card is, where all nodes that cards name have one, and where no
/// nodestring waits for its last node. Cards that nobody knows are whole with any letters.
bool is_whole_sms(const AcceptedFile& file, std::size_t cut) {
  const std::size_t mark = file.bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const std::vector<SmsCard> cards = cards_of(file.bytes.substr(mark, cut - std::min(cut, mark)));
  if (cut < mark || cards.empty() || cards.front() != SmsCard{"MESH2D"}) {
    return false;
  }
  std::vector<std::string> nodes;
  std::vector<std::string> named;
  bool in_nodestring = false;
  for (const SmsCard& card : cards) {
    const std::string& kind = card.front();
    const std::size_t corners = kind == "E3T" ? 3 : kind == "E2L" ? 2 : 0;
    if (kind == "ND") {
      if (card.size() < 5 || !is_number(card[2]) || !is_number(card[3]) || !is_number(card[4])) {
        return false;
      }
      nodes.push_back(card[1]);
    } else if (corners > 0) {
      if (card.size() < 2 + corners || (card.size() > 2 + corners && !is_whole_number(card[2 + corners]))) {
        return false;
      }
      named.insert(named.end(), card.begin() + 2, card.begin() + 2 + static_cast<std::ptrdiff_t>(corners));
    } else if (kind == "NS") {
      if (is_open_name(card.back())) {
        return false;
      }
      in_nodestring = true;
      for (std::size_t i = 1; i < card.size() && in_nodestring; ++i) {
        if (!is_whole_number(card[i])) {
          return false;
        }
        in_nodestring = card[i][0] != '-';
        named.push_back(card[i].substr(in_nodestring ? 0 : 1));
      }
    } else if (kind == "MAT") {
      if (card.size() < 3 || is_open_name(card[2])) {
        return false;
      }
    } else if (kind.size() > 1 && kind[0] == 'E' && '0' <= kind[1] && kind[1] <= '9') {
      return false;
    }
  }
  return !in_nodestring && std::ranges::all_of(named, [&nodes](const std::string& node) {
    return std::ranges::find(nodes, node) != nodes.end();
  });
}

}  // namespace

FormatSample sms_sample() {
  return {.format = trismooth::FileFormat::sms,
          .add_files = &add_sms,
          .is_whole = &is_whole_sms,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::some_cells; },
          .cells = {{cell_type::line, cell_type::quadratic_edge, cell_type::triangle, cell_type::quad,
                     cell_type::quadratic_triangle, cell_type::quadratic_quad, cell_type::biquadratic_quad}}};
}

}  // namespace accepted_files

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/text/number_text.h"

#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

constexpr std::string_view small_nodes =
    "GRID    1               0.      0.      0.\n"
    "GRID    2               2.      0.      0.\n"
    "GRID    3               2.      2.      0.\n"
    "GRID    4               0.      2.      0.\n"
    "GRID    5               .75     1.25    0.\n";

constexpr std::string_view large_nodes =
    "GRID*   1               0               0.              0.              *N1\n*N1     0.\n"
    "GRID*   2               0               2.              0.              *N2\n*N2     0.\n"
    "GRID*   3               0               2.              2.              *N3\n*N3     0.\n"
    "GRID*   4               0               0.              2.              *N4\n*N4     0.\n"
    "GRID*   5               0                            .75            1.25*N5\n*N5     0.\n";

constexpr std::string_view free_nodes =
    "GRID,1,0,0.00E+00,0.00E+00,0.00E+00\nGRID,2,0,2.000000,0.00E+00,0.00E+00\nGRID,3,0,2.000000,2.000000,0.00E+00\n"
    "GRID,4,0,0.00E+00,2.000000,0.00E+00\nGRID,5,0,7.5E-01,1.250000,0.00E+00\n";

constexpr std::string_view small_elements =
    "CTRIA3  1       1       1       2       5\n"
    "CTRIA3  2       1       2       3       5\n"
    "CTRIA3  3       2       3       4       5\n"
    "CTRIA3  4       2       4       1       5\n";

constexpr std::string_view free_elements = "CTRIA3,1,1,1,2,5\nCTRIA3,2,1,2,3,5\nCTRIA3,3,2,3,4,5\nCTRIA3,4,2,4,1,5\n";

std::string joined(std::string_view first, std::string_view second) {
  return std::string(first) + std::string(second);
}

std::string with_nastran_line_end(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

void add_nastran(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"nastran_" + name, ".bdf", std::move(bytes)});
  };
  const std::string plain = "BEGIN BULK\n" + joined(small_nodes, small_elements) + "ENDDATA\n";
  add("plain", plain);
  add("bare", joined(small_nodes, small_elements));
  // As Gmsh writes it.
  add("free",
      "$ Created by Gmsh\n" + joined(free_nodes, "CBAR,9,3,1,2,0.,0.,0.\n") + std::string(free_elements) + "ENDDATA\n");
  add("large", "$ Created by Gmsh\n" + joined(large_nodes, small_elements) + "ENDDATA\n");
  // As people run it.
  add("deck",
      "$ a deck\nSOL 101\nTIME 5\nCEND\nTITLE = a plate\nSUBCASE 1\n  SPC = 1\n  LOAD = 2\nBEGIN BULK\n"
      "PARAM,POST,-1\n$HMNAME PROP                   1\"left\" 4\n$HMNAME PROP                   2\"right\" 4\n" +
          joined(small_nodes, small_elements) +
          "PSHELL  1       1       .1      1               1\nPSHELL  2       1       .1      1               1\n"
          "MAT1    1       2.1+11          .3\nSPC1    1       123     1       THRU    2\n"
          "FORCE   2       3       0       1.      1.\nCONM2   7       4               1.\nENDDATA\n");
  add("mixed",
      "CTRIA3* 1               1               1               2\n*       5\nctria3,2,1,2,3,5\n"
      "CTRIAR\t3\t2\t3\t4\t5\nCTRIA3  4       2       4       1       5       $ the last\n\n"
      "GRID*   1\nGRID,2,,2.\n$ between\ngrid    3               2.0     +.2+1\nGRID*,4,,,2.,*A\n*A,0.\n"
      "GRID\t5\t\t7.5-1\t1.25D0\n");
  add("systems",
      "CORD2R  3               0.      0.      0.      0.      0.      1.\n+       1.      0.      0.\n"
      "GRDSET          3                               6\n" +
          joined(small_nodes, small_elements));
  add("crlf", with_nastran_line_end(plain, "\r\n"));
  add("cr", with_nastran_line_end(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("rest", plain + "made for a test\n");
}

/// A card of Nastran with the lines on which it goes on: what its fields say, of which the first is its name.
struct NastranText {
  std::vector<std::string> fields;
  std::string mark;  ///< behind the fields of its last line
  bool fits = true;  ///< its lines: each begins with the mark of the one before it, where both have one
};

/// A line as columns: tabs are blanks up to the next multiple of 8, comments are left out.
std::string columns_of(const std::string& line) {
  std::string columns;
  for (const char c : line.substr(0, line.find('$'))) {
    columns.append(c == '\t' ? 8 - columns.size() % 8 : 1, c == '\t' ? ' ' : c);
  }
  return columns;
}

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

/// The fields of a line in columns or between commas.
NastranText nastran_line(const std::string& columns) {
  NastranText line;
  if (contains(columns, ",")) {
    line.fields = fields_of(columns);
    const std::size_t count = contains(line.fields[0], "*") ? 5 : 9;
    line.mark = line.fields.size() > count ? line.fields[count] : "";
    line.fields.resize(count);
  } else {
    const std::size_t width = contains(columns.substr(0, 8), "*") ? 16 : 8;
    std::string padded = columns;
    padded.resize(std::max<std::size_t>(padded.size(), 80), ' ');
    line.fields.push_back(without_blanks(padded.substr(0, 8)));
    for (std::size_t at = 8; at < 72; at += width) {
      line.fields.push_back(without_blanks(padded.substr(at, width)));
    }
    line.mark = without_blanks(padded.substr(72, 8));
  }
  std::ranges::transform(line.fields[0], line.fields[0].begin(),
                         [](char c) { return 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c; });
  return line;
}

std::vector<NastranText> nastran_cards(std::string text) {
  std::ranges::replace(text, '\r', '\n');
  std::istringstream lines(text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0));
  std::vector<NastranText> cards;
  for (std::string line; std::getline(lines, line);) {
    const std::string columns = columns_of(line);
    if (columns.starts_with("BEGIN")) {
      cards.clear();  // what came before is no card
    } else if (columns.find_first_not_of(' ') != columns.npos) {
      NastranText card = nastran_line(columns);
      if (card.fields[0] == "ENDDATA") {
        break;
      }
      const bool goes_on = card.fields[0].empty() || contains("+*", card.fields[0].substr(0, 1));
      if (goes_on && !cards.empty()) {
        const std::string& head = card.fields[0];
        cards.back().fits = cards.back().mark.size() < 2 || head.size() < 2 || head == cards.back().mark;
        cards.back().fields.insert(cards.back().fields.end(), card.fields.begin() + 1, card.fields.end());
        cards.back().mark = card.mark;
      } else {
        std::erase(card.fields[0], '*');
        cards.push_back(std::move(card));
      }
    }
  }
  return cards;
}

/// Decks of Nastran have no end: they are whole where their last card is, where all nodes that elements name have a
/// GRID, and where they have one at all.
bool is_whole_nastran(const AcceptedFile& file, std::size_t cut) {
  const std::map<std::string, std::size_t> nodes_of{{"CTRIA3", 3}, {"CTRIAR", 3}, {"CBAR", 2}, {"CONM2", 1}};
  const auto is_id = [](const std::string& field) { return is_whole_number(field) && field[0] != '-'; };
  std::vector<std::string> nodes;
  std::vector<std::string> named;
  for (const NastranText& card : nastran_cards(file.bytes.substr(0, cut))) {
    const std::vector<std::string>& fields = card.fields;
    if (fields[0] == "GRID") {
      const std::string& z = fields.size() > 5 ? fields[5] : "";
      for (const std::string& coordinate : {fields[3], fields[4], z}) {
        if (!coordinate.empty() && !is_number(coordinate)) {
          return false;
        }
      }
      if (!is_id(fields[1]) || !card.fits || (z.empty() && card.mark.size() > 1)) {
        return false;
      }
      nodes.push_back(fields[1]);
    } else if (const auto element = nodes_of.find(fields[0]); element != nodes_of.end()) {
      const std::size_t first = fields[0] == "CONM2" ? 2 : 3;
      for (std::size_t i = first; i < first + element->second; ++i) {
        named.push_back(i < fields.size() ? fields[i] : "");
      }
      if (!is_id(fields[1])) {
        return false;
      }
    }
  }
  return !nodes.empty() && std::ranges::all_of(named, [&nodes](const std::string& node) {
    return std::ranges::find(nodes, node) != nodes.end();
  });
}

}  // namespace

FormatSample nastran_sample() {
  return {.format = trismooth::FileFormat::nastran,
          .add_files = &add_nastran,
          .is_whole = &is_whole_nastran,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::lines; },
          .cells = {{cell_type::line, cell_type::quadratic_edge, cell_type::triangle, cell_type::quad,
                     cell_type::quadratic_triangle, cell_type::quadratic_quad, cell_type::biquadratic_quad,
                     cell_type::tetrahedron, cell_type::pyramid, cell_type::wedge, cell_type::hexahedron,
                     cell_type::quadratic_tetrahedron, cell_type::quadratic_hexahedron, cell_type::quadratic_wedge,
                     cell_type::quadratic_pyramid}},
          .written_point =
              [](const std::array<double, 3>& point) {
                std::array<double, 3> written{};
                std::ranges::transform(point, written.begin(), [](double value) {
                  return trismooth::rounded_to_characters(value, 16, trismooth::NumberForm::nastran);
                });
                return written;
              }};
}

}  // namespace accepted_files

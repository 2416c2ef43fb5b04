// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <optional>
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

constexpr std::string_view inp_nodes =
    "1, 0.0, 0.0, 0.0\n2, 2.0, 0.0, 0.0\n3, 2.0, 2.0, 0.0\n4, 0.0, 2.0, 0.0\n5, 0.75, 1.25, 0.0\n";
constexpr std::string_view inp_elements = "1, 1, 2, 5\n2, 2, 3, 5\n3, 3, 4, 5\n4, 4, 1, 5\n";

std::string deck(std::string_view nodes, std::string_view elements) {
  return "*HEADING\na square\n*NODE, NSET=NALL\n" + std::string(nodes) + "*ELEMENT, TYPE=CPS3, ELSET=EALL\n" +
         std::string(elements);
}

std::string with_inp_line_end(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

void add_inp(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"inp_" + name, ".inp", std::move(bytes)});
  };
  const std::string plain = deck(inp_nodes, inp_elements);
  add("plain", plain);
  add("flat", deck("1, 0., 0.\n2, 2., 0.\n3, 2., 2.\n4, 0., 2.\n5, .75, 1.25\n", inp_elements));
  add("left_out", deck("1\n2, 2.\n3, 2., 2.\n4, , 2.\n5, 7.5D-1, 1.25, ,\n", inp_elements));
  // As Gmsh writes it.
  add("gmsh",
      "*Heading\n mesh.inp\n*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 2, 0\n4, 0, 2, 0\n5, 0.75, 1.25, 0\n"
      "******* E L E M E N T S *************\n*ELEMENT, type=T3D2, ELSET=Line1\n5, 1, 2\n"
      "*ELEMENT, type=CPS3, ELSET=Surface1\n1, 1, 2, 5\n2, 2, 3, 5\n*ELEMENT, type=CPS3, ELSET=Surface2\n3, 3, 4, 5\n"
      "4, 4, 1, 5\n*ELSET,ELSET=steel\n1, 2, \n*NSET,NSET=steel\n1, 2, 3, 5, \n");
  // As CalculiX takes it.
  add("sections", plain +
                      "*ELSET, ELSET=LEFT, GENERATE\n3, 4\n*ELSET, ELSET=RIGHT\n1, 2\n*ELSET, ELSET=BOTH\nLEFT, RIGHT\n"
                      "*SOLID SECTION, ELSET=LEFT, MATERIAL=M1\n1.\n*SOLID SECTION, ELSET=RIGHT, MATERIAL=M2\n1.\n"
                      "*BOUNDARY\n1, 1, 2\nNALL, 3\n*STEP\n*STATIC\n*CLOAD\n3, 1, 5.\n*END STEP\n");
  // As Abaqus/CAE writes it.
  add("parts", "*Heading\n** Job name: a Model name: b\n*Part, name=Plate\n*Node\n" + std::string(inp_nodes) +
                   "*Element, type=CPE3\n" + std::string(inp_elements) +
                   "*Nset, nset=Set-1, generate\n 1,  5,  1\n*Elset, elset=Set-1\n 1, 2\n"
                   "*Solid Section, elset=Set-1, material=Steel\n,\n*End Part\n*Assembly, name=Assembly\n"
                   "*Instance, name=Plate-1, part=Plate\n1., 0., 0.\n*End Instance\n*Nset, nset=_PickedSet4, internal, "
                   "instance=Plate-1\n 1, 4\n*End Assembly\n");
  add("broken_lines",
      "** first\n*Node ,\n nset = \"all of them\"\n\t1 , 0.0,+0.0\n** between\n\n2,2e0 , 0.\n3, 20e-1,.2E1\n"
      "4,0.0,2.0\n5,7.5-1, 12.5e-1\n*element,type = s3\n1,\n1,2,\n 5\n2,2,3,5,\n3,3,4,5\n4,4,1,5");
  add("user_elements", "*USER ELEMENT, NODES=2, TYPE=U1\n1, 2\n" + plain + "*ELEMENT, TYPE=U1\n9, 1, 2\n");
  add("crlf", with_inp_line_end(plain, "\r\n"));
  add("cr", with_inp_line_end(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
}

/// A keyword line, or several of which all but the last end with a comma.
struct InpKeywordLine {
  std::string name;                               ///< in upper case, without blanks
  std::map<std::string, std::string> parameters;  ///< their names likewise

  explicit InpKeywordLine(const std::string& text) {
    for (const std::string& field : fields_of(text)) {
      std::string key = field.substr(0, field.find('='));
      std::erase(key, ' ');
      std::ranges::transform(key, key.begin(), [](char c) { return 'a' <= c && c <= 'z' ? char(c - 'a' + 'A') : c; });
      const std::string value = field.find('=') == field.npos ? "" : field.substr(field.find('=') + 1);
      if (name.empty()) {
        name = key;
      } else {
        parameters[key] = value.substr(std::min(value.find_first_not_of(' '), value.size()));
      }
    }
  }
  std::string value_of(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
};

bool is_whole_inp_keyword(const InpKeywordLine& keyword) {
  if (keyword.name == "*ELEMENT") {
    return !keyword.value_of("TYPE").empty();
  }
  const std::string instance = keyword.value_of("INSTANCE");
  return (keyword.name != "*NSET" && keyword.name != "*ELSET") ||
         (!keyword.value_of(keyword.name.substr(1)).empty() && (instance.empty() || instance == "Plate-1"));
}

/// The last line of what a keyword line is followed by; several where an element goes on behind a comma.
bool is_whole_inp_data(const InpKeywordLine& keyword, const std::vector<std::string>& fields) {
  if (keyword.name == "*NODE") {
    return std::all_of(fields.begin() + 1, fields.end(),
                       [](const std::string& field) { return field.empty() || is_number(field); });
  }
  const auto filled = std::ranges::count_if(fields, [](const std::string& field) { return !field.empty(); });
  if (keyword.name == "*ELEMENT") {
    const std::string type = keyword.value_of("TYPE");
    return filled == 1 + (type == "U1" || type == "T3D2" ? 2 : 3);
  }
  return !keyword.parameters.contains("GENERATE") || filled >= 2;
}

/// Input files of Abaqus have no end: they are whole where their last line is, from the first *NODE on.
bool is_whole_inp(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(0, cut);
  std::ranges::replace(text, '\r', '\n');
  std::istringstream stream(text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0));
  std::optional<InpKeywordLine> keyword;
  std::string keyword_text;
  std::string data;
  bool has_nodes = false;
  for (std::string line; std::getline(stream, line);) {
    line = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    line.resize(line.find_last_not_of(" \t") + 1);
    if (line.empty() || line.starts_with("**")) {
      continue;
    }
    const bool goes_on = data.empty() && keyword_text.ends_with(',') && !contains("0123456789+-.*", line.substr(0, 1));
    if (line[0] == '*' || goes_on) {
      keyword_text = goes_on ? keyword_text + line : line;
      keyword.emplace(keyword_text);
      has_nodes = has_nodes || keyword->name == "*NODE";
      data.clear();
    } else {
      const bool is_in_element = keyword && keyword->name == "*ELEMENT" && data.ends_with(',') &&
                                 !is_whole_inp_data(*keyword, fields_of(data));
      data = is_in_element ? data + line : line;
    }
  }
  return has_nodes && is_whole_inp_keyword(*keyword) && (data.empty() || is_whole_inp_data(*keyword, fields_of(data)));
}

}  // namespace

FormatSample inp_sample() {
  return {.format = trismooth::FileFormat::inp,
          .add_files = &add_inp,
          .is_whole = &is_whole_inp,
          .rest_of = [](const AcceptedFile& /*file*/) { return Rest::lines; },
          .cells = {{cell_type::line, cell_type::quadratic_edge, cell_type::triangle, cell_type::quad,
                     cell_type::quadratic_triangle, cell_type::quadratic_quad, cell_type::biquadratic_quad,
                     cell_type::tetrahedron, cell_type::pyramid, cell_type::wedge, cell_type::hexahedron,
                     cell_type::quadratic_tetrahedron, cell_type::quadratic_hexahedron, cell_type::quadratic_wedge}},
          .written_point =
              [](const std::array<double, 3>& point) {
                std::array<double, 3> written{};
                std::ranges::transform(point, written.begin(),
                                       [](double value) { return trismooth::rounded_to_characters(value, 20); });
                return written;
              }};
}

}  // namespace accepted_files

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "input_checks.h"
#include "whole_files.h"

using accepted_files::AcceptedFile;
using trismooth::FileFormat;

namespace whole_files {

namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) {
    const std::size_t begin = std::min(field.find_first_not_of(" \t"), field.size());
    fields.push_back(field.substr(begin, field.find_last_not_of(" \t") + 1 - begin));
  }
  return fields;
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

bool is_whole_deck(const AcceptedFile& file, std::size_t cut) {
  switch (format_of(file)) {
    case FileFormat::inp:
      return is_whole_inp(file, cut);
    case FileFormat::nastran:
      return is_whole_nastran(file, cut);
    default:
      return is_whole_unv(file, cut);
  }
}

}  // namespace whole_files

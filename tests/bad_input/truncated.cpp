// Every file of the collection, cut at every byte. Most cuts are refused. Those that leave a whole file cannot be told
// from one: formats without an end or a count (OBJ, and the arrays of legacy VTK files) end wherever they are cut, and
// a last number is whole wherever it is cut. The rules below say which cuts these are; no other is accepted.
#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <regex>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;
using trismooth::DataArray;
using trismooth::MeshDocument;

namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

std::vector<std::string> words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> all;
  for (std::string word; stream >> word;) {
    all.push_back(word);
  }
  return all;
}

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

/// SU2 ends with its last marker, of which the last row may be cut within a last number, or with the dimension; what
/// follows may be any text.
bool is_whole_su2(const AcceptedFile& file, std::size_t cut) {
  if (contains(file.name, "no_markers")) {
    return cut >= file.bytes.find("NMARK= 0") + 8;
  }
  const std::string end = contains(file.name, "dimension_last") ? "NDIME=2" : "3 3 0";
  return cut >= file.bytes.find(end) + end.size();
}

/// MSH is whole behind every section from its elements on.
bool is_whole_msh(const AcceptedFile& file, std::size_t cut) {
  const std::size_t elements = file.bytes.find(contains(file.bytes, "$ENDELM") ? "$ENDELM" : "$EndElements");
  for (std::size_t end = elements; end != file.bytes.npos; end = file.bytes.find("$End", end + 1)) {
    std::size_t from = end;
    while (from < file.bytes.size() && !is_space(file.bytes[from])) {
      ++from;
    }
    const std::size_t next = file.bytes.find('$', from);
    if (from <= cut && (next == file.bytes.npos || cut <= next)) {
      return true;
    }
  }
  return false;
}

/// XML ends with the end of its root.
bool is_whole_xml(const AcceptedFile& file, std::size_t cut) {
  const std::string_view end = "</VTKFile>";
  return cut >= file.bytes.rfind(end) + end.size();
}

/// The last number that a file needs, where it is a coordinate at the end of a text without an end of its own: cut, it
/// is another number, which no reader can tell.
std::string_view last_coordinate(const AcceptedFile& file) {
  if (format_of(file) == trismooth::FileFormat::mfem && !contains(file.bytes, "mesh_end")) {
    const std::string_view bytes = file.bytes;
    const std::size_t end = bytes.find_last_not_of(" \r\n") + 1;
    const std::size_t begin = bytes.find_last_of(" \n", end - 1) + 1;
    return bytes.substr(begin, end - begin);
  }
  return {};
}

/// From version 1.1 on MFEM's meshes have an end.
bool is_whole_mfem(const AcceptedFile& file, std::size_t cut) {
  constexpr std::string_view end = "mesh_end";
  const std::size_t found = file.bytes.find(end);
  return found != file.bytes.npos && cut >= found + end.size();
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

/// What a section of a text of Medit needs beside its count for every row; nothing for sections that are not read.
std::optional<std::size_t> numbers_of_medit(const std::string& keyword, std::size_t dimension) {
  std::string lower = keyword;
  std::ranges::transform(lower, lower.begin(), [](char c) { return 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (lower == "vertices") {
    return dimension + 1;
  }
  if (lower == "edges" || lower == "triangles") {
    return lower == "edges" ? 3 : 4;
  }
  const bool is_set = lower == "corners" || lower == "ridges" || lower == "requiredvertices" ||
                      lower == "requirededges" || lower == "requiredtriangles";
  return is_set ? std::optional<std::size_t>(1) : std::nullopt;
}

/// Text of Medit may end behind every whole section, and in those that are not read, where it has its vertices.
bool is_whole_medit_text(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes.substr(file.bytes.find_first_of("#M "));
  text.resize(cut - std::min(cut, file.bytes.size() - text.size()));
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at)) {
    text.erase(at, std::min(text.find_first_of("\r\n", at), text.size()) - at);
  }
  const std::vector<std::string> all = words(text);
  std::size_t dimension = 0;
  bool has_vertices = false;
  for (std::size_t i = 2; i < all.size();) {
    const std::string& keyword = all[i++];
    if (keyword == "Dimension") {
      if (i == all.size()) {
        return false;
      }
      dimension = std::stoul(all[i++]);
    } else if (const auto numbers = numbers_of_medit(keyword, dimension)) {
      if (i == all.size() || *numbers * std::stoul(all[i]) > all.size() - i - 1) {
        return false;
      }
      has_vertices = has_vertices || *numbers == dimension + 1;
      i += 1 + *numbers * std::stoul(all[i]);
    } else {
      while (i < all.size() && contains("\"+-=.0123456789", all[i].substr(0, 1))) {
        ++i;
      }
    }
  }
  return has_vertices;
}

/// Binary files of Medit may end behind every block from the vertices on.
bool is_whole_medit_binary(const AcceptedFile& file, std::size_t cut) {
  const bool big_endian = contains(file.name, "_big_");
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = 256 * value + static_cast<unsigned char>(file.bytes[big_endian ? at + i : at + size - 1 - i]);
    }
    return value;
  };
  const std::size_t position_bytes = contains("12", file.name.substr(6, 1)) ? 4 : 8;
  const std::size_t vertices = number(12, position_bytes);
  std::size_t at = number(vertices + 4, position_bytes);
  while (at < cut && number(at + 4, position_bytes) != 0) {
    at = number(at + 4, position_bytes);
  }
  return at == cut;
}

/// FreeFem's text ends with its last number, wherever that is cut.
bool is_whole_freefem(const AcceptedFile& file, std::size_t cut) {
  const std::size_t last = file.bytes.find_last_not_of(" \r\n");
  return cut > file.bytes.find_last_of(" \r\n", last) + (contains(file.name, "negative") ? 2 : 1);
}

/// The elements of Triangle's end with their last number, wherever that is cut; comments may follow.
bool is_whole_triangle(const AcceptedFile& file, std::size_t cut) {
  std::string text = file.bytes;
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at)) {
    const std::size_t end = std::min(text.find_first_of("\r\n\x1C", at), text.size());
    text.replace(at, end - at, end - at, ' ');
  }
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  const std::size_t begin = text.find_last_of(" \t\r\n", last) + 1;
  return cut > begin + (text[begin] == '-' ? 1 : 0);
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

/// Whether the text is a number, with Fortran's exponents.
bool is_number(const std::string& text) {
  static const std::regex number("[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eEdD][+-]?[0-9]+|[+-][0-9]+)?");
  return std::regex_match(text, number);
}

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789", text[0] == '-' ? 1 : 0) == text.npos && text != "-";
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

bool is_whole(const AcceptedFile& file, std::size_t cut) {
  if (format_of(file) == trismooth::FileFormat::unv) {
    return is_whole_unv(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::freefem) {
    return is_whole_freefem(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::medit) {
    return contains(file.name, "endian") ? is_whole_medit_binary(file, cut) : is_whole_medit_text(file, cut);
  }
  if (const std::string_view last = last_coordinate(file); !last.empty()) {
    return cut > static_cast<std::size_t>(last.data() - file.bytes.data());
  }
  if (format_of(file) == trismooth::FileFormat::mfem) {
    return is_whole_mfem(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::triangle) {
    return is_whole_triangle(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::sms) {
    return is_whole_sms(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::inp) {
    return is_whole_inp(file, cut);
  }
  if (format_of(file) == trismooth::FileFormat::nastran) {
    return is_whole_nastran(file, cut);
  }
  return file.extension == ".off"   ? is_whole_off(file, cut)
         : file.extension == ".obj" ? is_whole_obj(file, cut)
         : file.extension == ".ply" ? is_whole_ply(file, cut)
         : file.extension == ".stl" ? is_whole_stl(file, cut)
         : file.extension == ".vtk" ? is_whole_legacy(file, cut)
         : file.extension == ".msh" ? is_whole_msh(file, cut)
         : file.extension == ".su2" ? is_whole_su2(file, cut)
         : file.extension == ".14"  ? is_whole_adcirc(file, cut)
                                    : is_whole_xml(file, cut);
}

template <class T>
bool starts_as(const std::vector<T>& part, const std::vector<T>& whole, std::size_t last_apart = 0) {
  const std::size_t length = part.size() - std::min(part.size(), last_apart);
  return part.size() <= whole.size() &&
         std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(length), whole.begin());
}

/// Every array is one of the whole file, up to its last number.
bool arrays_start_as(std::span<const DataArray> part, std::span<const DataArray> whole) {
  return std::ranges::all_of(part, [whole](const DataArray& array) {
    const DataArray* const same = find_array(whole, array.name);
    const std::size_t certain = array.bytes.size() - std::min(array.bytes.size(), size_of(array.type));
    return same != nullptr && same->type == array.type && array.bytes.size() <= same->bytes.size() &&
           std::ranges::equal(array.bytes.first(certain), same->bytes.first(certain));
  });
}

/// Nodes and elements are those of the lines that are there, but the coordinates of the last node, of which any may be
/// left out. What the sets say is known at the end of the file only.
std::string_view not_a_beginning_of_deck(const MeshDocument& part, const MeshDocument& whole) {
  return starts_as(part.points, whole.points, 3) && starts_as(part.cells.connectivity, whole.cells.connectivity) &&
                 starts_as(part.cells.types, whole.cells.types)
             ? ""
             : "is accepted, and not as the beginning of the mesh";
}

/// The last cell of a file without counts may have lost vertices.
std::string_view not_a_beginning(const MeshDocument& part, const MeshDocument& whole, bool all_cells) {
  if (all_cells && (part.points != whole.points || part.cells.connectivity != whole.cells.connectivity)) {
    return "is accepted as another mesh";
  }
  return starts_as(part.points, whole.points) && starts_as(part.cells.connectivity, whole.cells.connectivity) &&
                 starts_as(part.cells.types, whole.cells.types, all_cells ? 0 : 1) &&
                 arrays_start_as(part.point_arrays, whole.point_arrays) &&
                 arrays_start_as(part.cell_arrays, whole.cell_arrays) &&
                 arrays_start_as(part.field_arrays, whole.field_arrays)
             ? ""
             : "is accepted, and not as the beginning of the mesh";
}

}  // namespace

TEST_CASE("A file cut anywhere is refused unless what is left is a whole file") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    const MeshDocument whole = read(file).document.value();
    // Only these formats can end after some of the cells.
    const bool all_cells = file.extension != ".obj" && !file.name.starts_with("stl_ascii") &&
                           !file.name.starts_with("medit") && !file.name.starts_with("2dm") &&
                           !file.name.starts_with("unv") && !contains(file.name, "_poly_");
    const bool is_deck =
        format_of(file) == trismooth::FileFormat::inp || format_of(file) == trismooth::FileFormat::nastran;
    for (std::size_t cut = 0; cut < file.bytes.size(); cut += stride_of(file)) {
      const std::string place = fmt::format("cut at byte {}", cut);
      const Outcome outcome = read(file, file.bytes.substr(0, cut));
      faults.add_any(file.name, place, outcome.fault);
      if (outcome.document.has_value() != is_whole(file, cut)) {
        faults.add(file.name, place, outcome.document ? "is accepted" : outcome.message);
      } else if (outcome.document && last_coordinate(file).empty()) {
        faults.add_any(file.name, place,
                       is_deck ? not_a_beginning_of_deck(*outcome.document, whole)
                               : not_a_beginning(*outcome.document, whole, all_cells));
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("A last index that is cut short is another index: no reader of text can tell") {
  std::string text = "OFF\n12 1 0\n";
  for (int i = 0; i < 12; ++i) {
    text += fmt::format("{} {} 0\n", i, i * i);
  }
  text += "3 0 1 11";
  const AcceptedFile file{"last_index", ".off", text};
  CHECK(read(file).document.value().cells.connectivity.back() == 11);
  CHECK(read(file, text.substr(0, text.size() - 1)).document.value().cells.connectivity.back() == 1);
  CHECK(!read(file, text.substr(0, text.size() - 2)).document);
}

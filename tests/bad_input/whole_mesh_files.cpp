#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "input_checks.h"
#include "whole_files.h"

using accepted_files::AcceptedFile;
using trismooth::FileFormat;

namespace whole_files {

namespace {

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

bool is_whole_mesh(const AcceptedFile& file, std::size_t cut) {
  switch (format_of(file)) {
    case FileFormat::freefem:
      return is_whole_freefem(file, cut);
    case FileFormat::medit:
      return contains(file.name, "endian") ? is_whole_medit_binary(file, cut) : is_whole_medit_text(file, cut);
    case FileFormat::mfem:
      return is_whole_mfem(file, cut);
    case FileFormat::triangle:
      return is_whole_triangle(file, cut);
    case FileFormat::sms:
      return is_whole_sms(file, cut);
    case FileFormat::msh:
      return is_whole_msh(file, cut);
    case FileFormat::su2:
      return is_whole_su2(file, cut);
    default:
      return is_whole_adcirc(file, cut);
  }
}

}  // namespace whole_files

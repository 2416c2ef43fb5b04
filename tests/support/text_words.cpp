// SPDX-License-Identifier: BSD-3-Clause
#include "support/text_words.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace accepted_files {

std::string with_line_ends(std::string_view text, std::string_view line_end) {
  std::string changed;
  for (const char c : text) {
    changed += c == '\n' ? std::string(line_end) : std::string(1, c);
  }
  return changed;
}

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

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) {
    const std::size_t begin = std::min(field.find_first_not_of(" \t"), field.size());
    fields.push_back(field.substr(begin, field.find_last_not_of(" \t") + 1 - begin));
  }
  return fields;
}

bool is_number(const std::string& text) {
  static const std::regex number("[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eEdD][+-]?[0-9]+|[+-][0-9]+)?");
  return std::regex_match(text, number);
}

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789", text[0] == '-' ? 1 : 0) == text.npos && text != "-";
}

}  // namespace accepted_files

#include "whole_files.h"

#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "input_checks.h"

using accepted_files::AcceptedFile;
using trismooth::FileFormat;

namespace whole_files {

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

bool is_number(const std::string& text) {
  static const std::regex number("[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eEdD][+-]?[0-9]+|[+-][0-9]+)?");
  return std::regex_match(text, number);
}

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789", text[0] == '-' ? 1 : 0) == text.npos && text != "-";
}

std::string_view last_coordinate(const AcceptedFile& file) {
  if (format_of(file) == trismooth::FileFormat::mfem && !contains(file.bytes, "mesh_end")) {
    const std::string_view bytes = file.bytes;
    const std::size_t end = bytes.find_last_not_of(" \r\n") + 1;
    const std::size_t begin = bytes.find_last_of(" \n", end - 1) + 1;
    return bytes.substr(begin, end - begin);
  }
  return {};
}

bool is_whole(const AcceptedFile& file, std::size_t cut) {
  if (const std::string_view last = last_coordinate(file); !last.empty()) {
    return cut > static_cast<std::size_t>(last.data() - file.bytes.data());
  }
  switch (format_of(file)) {
    case FileFormat::off:
    case FileFormat::obj:
    case FileFormat::ply:
    case FileFormat::stl:
    case FileFormat::vtk:
    case FileFormat::vtu:
    case FileFormat::vtp:
      return is_whole_general(file, cut);
    case FileFormat::inp:
    case FileFormat::nastran:
    case FileFormat::unv:
      return is_whole_deck(file, cut);
    default:
      return is_whole_mesh(file, cut);
  }
}

}  // namespace whole_files

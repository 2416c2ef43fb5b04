// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != text.npos;
}

namespace accepted_files {

/// The text with another line end in place of each "\n".
std::string with_line_ends(std::string_view text, std::string_view line_end);

bool is_space(char c);
/// Divided by white space.
std::vector<std::string> words(std::string_view text);
/// Divided by commas, without the blanks around them.
std::vector<std::string> fields_of(const std::string& line);
/// Whether the text is a number, with Fortran's exponents.
bool is_number(const std::string& text);
bool is_whole_number(const std::string& text);

}  // namespace accepted_files

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace trismooth {

/// A line of an SU2 mesh that is a keyword with its value: "NPOIN= 98".
struct Su2KeywordLine {
  std::string_view keyword;
  std::string_view value;  ///< without blanks at its ends, and without a comment
};

/// The line as one; blanks may stand on both sides of the '='. Nothing for rows of numbers, comments and other text.
std::optional<Su2KeywordLine> parse_su2_keyword_line(std::string_view line);

/// Whether a text is an SU2 mesh, by its first line with a keyword.
bool recognises_su2(std::string_view bytes);

}  // namespace trismooth

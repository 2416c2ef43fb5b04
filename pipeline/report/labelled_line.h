// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The text in lines of 80 columns, broken at blanks: the first one behind `first_indent`, the others behind `indent`.
/// A word that is longer has a line of its own. Ends in a line feed.
std::string wrapped(std::string_view text, std::string_view first_indent, std::string_view indent);

/// "written:    out.vtu": a line of a result for people, printable() and wrapped under its beginning. The label has
/// at most 11 characters.
std::string labelled_line(std::string_view label, std::string_view text);

}  // namespace trismooth

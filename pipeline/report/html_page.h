// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// The pieces that all pages of the program are made of. Arguments are HTML unless they are said to be text.

/// A whole page with the common style sheet (html_style.h) and `more_style` behind it. `title` is text.
std::string html_page(std::string_view title, std::string body, std::string_view more_style = "");

/// A part of a page under a heading.
std::string html_section(std::string_view title, std::string_view content);

/// What is before and behind the content of such a part.
std::string html_section_begin(std::string_view title);
inline constexpr std::string_view html_section_end = "</section>\n";

/// A cell of a table, of these classes. In a table of the class "stack", which narrow windows show without its head,
/// `label` (text) is what the column is called.
std::string html_cell(std::string_view content, std::string_view classes = "", std::string_view label = "");

/// A list of points, each of them text.
std::string html_list(const std::vector<std::string>& texts);

}  // namespace trismooth

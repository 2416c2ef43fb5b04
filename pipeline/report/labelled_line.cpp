// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/labelled_line.h"

#include <algorithm>

#include <fmt/format.h>

#include "trismooth/base/text/printable_text.h"
#include "trismooth/pipeline/report/terminal.h"

namespace trismooth {

std::string wrapped(std::string_view text, std::string_view first_indent, std::string_view indent) {
  std::string lines;
  std::string line(first_indent);
  bool is_empty = true;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (!is_empty && line.size() + 1 + word.size() > line_columns) {
      lines += line + '\n';
      line = indent;
      is_empty = true;
    }
    line.append(is_empty ? "" : " ").append(word);
    is_empty = false;
  }
  return lines + line + '\n';
}

std::string labelled_line(std::string_view label, std::string_view text) {
  constexpr std::size_t label_columns = 12;
  return wrapped(printable(text), fmt::format("{:<{}}", label, label_columns), std::string(label_columns, ' '));
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/text/text_columns.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace trismooth {

namespace {

/// Characters of a text in UTF-8, each of which takes a column.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

void append_line(std::string& text, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  text += line;
  text += '\n';
}

}  // namespace

TextColumns::TextColumns(std::vector<Column> columns) : columns_(std::move(columns)), widths_(columns_.size(), 0) {}

void TextColumns::add_row(std::vector<std::string> cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    widths_[i] = std::max(widths_[i], width_of(cells[i]));
  }
  rows_.push_back(std::move(cells));
}

std::string TextColumns::text(const std::vector<Title>& titles) const {
  std::string text;
  if (!titles.empty()) {
    std::string line;
    std::size_t column = 0;
    const auto skip_to = [&](std::size_t next) {
      for (; column < next; ++column) {
        line.append(columns_[column].gap + widths_[column], ' ');
      }
    };
    for (const Title& title : titles) {
      skip_to(title.first);
      const std::size_t begin = line.size() + columns_[title.first].gap;
      skip_to(title.last + 1);
      const std::size_t spare = line.size() - begin - std::min(title.text.size(), line.size() - begin);
      line.replace(begin + spare / 2, title.text.size(), title.text);
    }
    append_line(text, std::move(line));
  }
  for (const std::vector<std::string>& cells : rows_) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      line.append(columns_[i].gap, ' ');
      const std::string padding(widths_[i] - width_of(cells[i]), ' ');
      line += columns_[i].align == Align::left ? cells[i] + padding : padding + cells[i];
    }
    append_line(text, std::move(line));
  }
  return text;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_line.h"

#include <algorithm>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

namespace {

std::string_view without_blanks_behind(std::string_view text) {
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Finds the bytes of columns, asked for in ascending order.
class NastranColumns {
 public:
  explicit NastranColumns(std::string_view text)
      : text_(text), has_tabs_(text.find('\t') != std::string_view::npos), column_(has_tabs_ ? 0 : text.size()) {}

  /// Where that column, a multiple of 8 from 0 on, begins; the end of the text where it ends before that.
  std::size_t begin_of(std::size_t column) {
    if (!has_tabs_) {
      return std::min(column, text_.size());
    }
    constexpr std::size_t tab_columns = 8;
    while (column_ < column && at_ < text_.size()) {
      column_ = text_[at_] == '\t' ? (column_ / tab_columns + 1) * tab_columns : column_ + 1;
      ++at_;
    }
    return at_;
  }

  /// Whether the text goes as far as to that column, the one that was asked for last.
  bool reaches(std::size_t column) const { return column_ >= column; }

 private:
  std::string_view text_;
  bool has_tabs_;
  std::size_t column_;
  std::size_t at_ = 0;
};

void divide_columns(NastranLine& line, std::string_view data) {
  NastranColumns columns(data);
  std::size_t begin = columns.begin_of(nastran_head_columns);
  line.head = data.substr(0, begin);
  const std::string_view name = trimmed(line.head);
  line.count = name.starts_with('*') || name.ends_with('*') ? most_nastran_fields / 2 : most_nastran_fields;
  for (std::size_t i = 0; i < line.count; ++i) {
    const std::size_t behind = nastran_head_columns + (i + 1) * line.width();
    const std::size_t end = columns.begin_of(behind);
    line.fields[i] = data.substr(begin, end - begin);
    if (end > begin) {
      line.present = i + 1;
      line.last_is_short = !columns.reaches(behind);
    }
    begin = end;
  }
  line.tail = line.text.substr(begin);
}

void divide_commas(NastranLine& line, std::string_view data) {
  line.is_free = true;
  const std::string_view text = without_blanks_behind(data);
  std::size_t end = std::min(text.find(','), text.size());
  line.head = text.substr(0, end);
  const std::string_view name = trimmed(line.head);
  line.count = name.starts_with('*') || name.ends_with('*') ? most_nastran_fields / 2 : most_nastran_fields;
  for (std::size_t i = 0; i < line.count; ++i) {
    if (end == text.size()) {
      line.fields[i] = text.substr(end);
      continue;
    }
    const std::size_t begin = end + 1;
    end = std::min(text.find(',', begin), text.size());
    line.fields[i] = text.substr(begin, end - begin);
    line.present = i + 1;
  }
  line.tail = line.text.substr(end);
}

}  // namespace

NastranLine divide_nastran_line(std::string_view text) {
  NastranLine line;
  line.text = text;
  const std::string_view data = text.substr(0, text.find('$'));
  if (data.find(',') == std::string_view::npos) {
    divide_columns(line, data);
  } else {
    divide_commas(line, data);
  }
  return line;
}

bool NastranLine::is_continuation() const {
  const std::string_view name = trimmed(head);
  return name.empty() || name.starts_with('+') || name.starts_with('*');
}

std::string NastranLine::name() const {
  std::string_view name = trimmed(head);
  if (name.ends_with('*')) {
    name = trimmed(name.substr(0, name.size() - 1));
  }
  return nastran_key(name);
}

std::string_view NastranLine::mark() const {
  std::string_view rest = tail.substr(0, tail.find('$'));
  if (is_free) {
    rest = rest.empty() ? rest : rest.substr(1);
    return trimmed(rest.substr(0, rest.find(',')));
  }
  return trimmed(rest.substr(0, nastran_head_columns));
}

bool is_empty_nastran_line(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos || text[first] == '$';
}

std::string nastran_key(std::string_view text) {
  return upper_case(text);
}

bool begins_with_nastran_word(std::string_view line, std::string_view word) {
  const std::string_view text = trimmed(line);
  const bool begins =
      text.size() >= word.size() &&
      std::equal(word.begin(), word.end(), text.begin(), [](char wanted, char c) { return wanted == upper_letter(c); });
  const char next = begins && text.size() > word.size() ? upper_letter(text[word.size()]) : ' ';
  return begins && !(next >= 'A' && next <= 'Z') && !(next >= '0' && next <= '9');
}

}  // namespace trismooth

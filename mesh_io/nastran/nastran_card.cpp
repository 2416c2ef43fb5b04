// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_card.h"

#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/line_parts.h"

namespace trismooth {

std::string_view NastranCard::field(std::size_t i) const {
  const std::size_t row = i / most_nastran_fields;
  if (row >= rows_.size()) {
    return {};
  }
  const NastranLine& first = lines[rows_[row].first];
  const std::size_t place = i % most_nastran_fields;
  if (place < first.count) {
    return trimmed(first.fields[place]);
  }
  return rows_[row].has_two ? trimmed(lines[rows_[row].first + 1].fields[place - first.count]) : std::string_view();
}

void NastranCard::start(const NastranLine& line) {
  name = line.name();
  lines.assign(1, line);
  rows_.assign(1, {0, false});
}

void NastranCard::add(const NastranLine& line) {
  Row& last = rows_.back();
  if (line.is_large() && lines[last.first].is_large() && !last.has_two) {
    last.has_two = true;
  } else {
    rows_.push_back({lines.size(), false});
  }
  lines.push_back(line);
}

bool NastranLines::next() {
  if (at_ >= text_.size()) {
    return false;
  }
  const std::size_t end = find_line_end(text_, at_);
  line_ = text_.substr(at_, end - at_);
  at_ = end;
  if (at_ < text_.size()) {
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
  }
  return true;
}

std::size_t read_nastran_card(std::string_view text, std::size_t begin, NastranCard& card) {
  NastranLines lines(text, begin);
  lines.next();
  card.start(divide_nastran_line(lines.line()));
  std::size_t end = lines.offset();
  while (lines.next()) {
    if (is_empty_nastran_line(lines.line())) {
      continue;
    }
    const NastranLine line = divide_nastran_line(lines.line());
    if (!line.is_continuation()) {
      break;
    }
    card.add(line);
    end = lines.offset();
  }
  return end;
}

}  // namespace trismooth

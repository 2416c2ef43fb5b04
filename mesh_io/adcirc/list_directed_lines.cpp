// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/adcirc/list_directed_lines.h"

#include <algorithm>
#include <string>

#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/expected_number.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::string_view list_separators = " \t\v\f,";

bool is_digit(char c) {
  return '0' <= c && c <= '9';
}

}  // namespace

void ListDirectedLines::next_line(std::string_view what) {
  end_line();
  do {
    value_offset_ = scanner_.offset();
    if (scanner_.offset() == scanner_.text().size()) {
      fail("expected " + std::string(what) + ", got the end of the file");
    }
    line_offset_ = scanner_.offset();
    line_ = scanner_.next_line();
  } while (line_.find_first_not_of(blanks) == std::string_view::npos);
  at_ = 0;
  has_blanks_ = false;
  has_commas_ = false;
}

void ListDirectedLines::end_line() const {
  const std::size_t next = line_.find_first_not_of(list_separators, at_);
  if (at_ == 0 || next == std::string_view::npos || next == at_ || !is_digit(line_[next])) {
    return;
  }
  // "1.5,0" or "1,5 0" where one number is read or two are.
  if (has_commas_ != (line_[at_] == ',') && next == at_ + 1) {
    fail("numbers have a decimal point, and are separated by commas or by blanks alone, got " + quoted(line_));
  }
}

/// The value begins at line_[begin]; empty at the end of the line, and where a comma follows another.
std::string_view ListDirectedLines::peek_value(std::size_t& begin) const {
  begin = std::min(line_.find_first_not_of(blanks, at_), line_.size());
  // The comma behind the last value.
  if (begin < line_.size() && line_[begin] == ',' && at_ > 0) {
    begin = std::min(line_.find_first_not_of(blanks, begin + 1), line_.size());
  }
  const std::size_t end = std::min(line_.find_first_of(list_separators, begin), line_.size());
  return line_.substr(begin, end - begin);
}

std::string_view ListDirectedLines::next_value(std::string_view what) {
  std::size_t begin = 0;
  const std::string_view value = peek_value(begin);
  value_offset_ = line_offset_ + begin;
  if (value.empty()) {
    fail("expected " + std::string(what) + ", got " + (begin == line_.size() ? "the end of the line" : "a comma"));
  }
  take_value(begin, value);
  return value;
}

/// "1 1,5 0": a comma that separates, or a decimal comma?
void ListDirectedLines::require_one_separator(std::size_t begin) {
  if (at_ == 0) {
    return;
  }
  const bool has_comma = line_.substr(at_, begin - at_).find(',') != std::string_view::npos;
  (has_comma ? has_commas_ : has_blanks_) = true;
  if (has_commas_ && has_blanks_) {
    fail("numbers have a decimal point, and are separated by commas or by blanks alone, got " + quoted(line_));
  }
}

void ListDirectedLines::take_value(std::size_t begin, std::string_view value) {
  value_offset_ = line_offset_ + begin;
  require_one_separator(begin);
  at_ = begin + value.size();
}

std::int64_t ListDirectedLines::next_integer(std::string_view what, std::int64_t lowest, std::int64_t highest) {
  const std::string_view value = next_value(what);
  const std::int64_t number = whole_number(value, what, [this](const std::string& message) { fail(message); });
  if (number < lowest || number > highest) {
    fail("expected " + std::string(what) + " from " + std::to_string(lowest) + " to " + std::to_string(highest) +
         ", got " + quoted(value));
  }
  return number;
}

double ListDirectedLines::next_number(std::string_view what) {
  return finite_number(next_value(what), what, [this](const std::string& message) { fail(message); });
}

double ListDirectedLines::next_number_or_none(std::string_view what) {
  return finite_number_or_none(next_value(what), what, [this](const std::string& message) { fail(message); });
}

std::optional<std::int64_t> ListDirectedLines::next_integer_if_any() {
  std::size_t begin = 0;
  const std::string_view value = peek_value(begin);
  const std::optional<std::int64_t> number = parse_integer(value);
  if (number) {
    take_value(begin, value);
  }
  return number;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/sms/sms_line.h"

#include <string>

#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/expected_number.h"

namespace trismooth {

SmsLine::SmsLine(TextScanner& scanner)
    : scanner_(scanner), offset_(scanner.offset()), line_(scanner.next_line()), word_offset_(offset_) {}

std::optional<std::string_view> SmsLine::next_word() {
  while (at_ < line_.size() && is_blank(line_[at_])) {
    ++at_;
  }
  word_offset_ = offset_ + at_;
  is_quoted_ = at_ < line_.size() && line_[at_] == '"';
  if (at_ == line_.size() || line_[at_] == '#') {
    at_ = line_.size();
    return std::nullopt;
  }
  if (is_quoted_) {
    const std::size_t end = line_.find('"', at_ + 1);
    if (end == std::string_view::npos) {
      fail("expected a quotation mark behind " + quoted(line_.substr(at_)));
    }
    const std::string_view word = line_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return word;
  }
  std::size_t end = at_;
  while (end < line_.size() && !is_blank(line_[end]) && line_[end] != '#') {
    ++end;
  }
  const std::string_view word = line_.substr(at_, end - at_);
  at_ = end;
  return word;
}

std::string_view SmsLine::require_word(std::string_view what) {
  const auto word = next_word();
  if (!word) {
    fail("expected " + std::string(what) + ", got the end of the line");
  }
  return *word;
}

std::int64_t SmsLine::next_integer(std::string_view what) {
  return whole_number(require_word(what), what, [this](const std::string& message) { fail(message); });
}

double SmsLine::next_number(std::string_view what) {
  return finite_number(require_word(what), what, [this](const std::string& message) { fail(message); });
}

double SmsLine::next_number_or_none(std::string_view what) {
  return finite_number_or_none(require_word(what), what, [this](const std::string& message) { fail(message); });
}

}  // namespace trismooth

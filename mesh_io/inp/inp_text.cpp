// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_text.h"

#include <algorithm>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// In upper case, without blanks.
std::string squeezed(std::string_view text) {
  std::string changed;
  for (const char c : text) {
    if (!is_blank(c)) {
      changed += upper_letter(c);
    }
  }
  return changed;
}

bool is_quoted(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"';
}

/// Where the part of a keyword line or a field that begins at `begin` ends: at a comma outside quotation marks.
std::size_t end_of_part(std::string_view line, std::size_t begin) {
  bool quoted = false;
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      return i;
    }
  }
  return quoted ? std::min(line.find(',', begin), line.size()) : line.size();
}

bool begins_number(std::string_view line) {
  return !line.empty() && std::string_view("0123456789+-.").find(line.front()) != std::string_view::npos;
}

}  // namespace

const InpParameter* InpKeyword::find(std::string_view parameter) const {
  const auto found = std::ranges::find(parameters, parameter, &InpParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::string_view InpKeyword::value_of(std::string_view parameter) const {
  const InpParameter* const found = find(parameter);
  return found == nullptr ? std::string_view() : found->value;
}

InpLines::InpLines(std::string_view text)
    : text_(without_end_mark(text)), at_(begin_of_text(text)), line_(text_.substr(0, 0)) {}

/// The next line without its end.
std::string_view InpLines::raw_line() {
  const std::size_t begin = at_;
  const std::size_t end = find_line_end(text_, begin);
  at_ = end;
  if (at_ < text_.size()) {
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
  }
  return text_.substr(begin, end - begin);
}

/// Goes to the next line that is neither blank nor a comment; false where there is none.
bool InpLines::next_line() {
  while (at_ < text_.size()) {
    const std::string_view line = trimmed(raw_line());
    if (!line.empty() && !line.starts_with("**")) {
      line_ = line;
      return true;
    }
  }
  line_ = text_.substr(text_.size());
  return false;
}

InpLines::Kind InpLines::next() {
  if (!next_line()) {
    return Kind::end;
  }
  return line_.starts_with('*') ? Kind::keyword : Kind::data;
}

InpKeyword InpLines::keyword() {
  InpKeyword keyword;
  keyword.begin = offset();
  bool has_name = false;
  std::size_t comma = keyword.begin;
  for (bool more = true; more;) {
    const std::size_t line_begin = offset();
    std::size_t begin = has_name ? 0 : 1;
    for (bool is_last = false; !is_last;) {
      const std::size_t end = end_of_part(line_, begin);
      const std::string_view part = trimmed(line_.substr(begin, end - begin));
      is_last = end == line_.size();
      if (!has_name) {
        keyword.name = squeezed(part);
        has_name = true;
      } else if (!part.empty()) {
        const std::size_t equals = std::min(part.find('='), part.size());
        keyword.parameters.push_back({squeezed(part.substr(0, equals)),
                                      trimmed(part.substr(std::min(equals + 1, part.size()))), comma,
                                      static_cast<std::size_t>(part.data() - text_.data()) + part.size()});
      }
      comma = line_begin + end;
      begin = end + 1;
    }
    keyword.end = line_begin + line_.size();
    more = false;
    if (inp_goes_on(line_)) {
      const std::size_t behind = at_;
      const std::string_view last = line_;
      more = next_line() && !line_.starts_with('*') && !begins_number(line_);
      if (!more) {
        at_ = behind;
        line_ = last;
      }
    }
  }
  return keyword;
}

bool InpFields::next() {
  if (is_last_) {
    return false;
  }
  const std::size_t end = end_of_part(rest_, 0);
  field_ = trimmed(rest_.substr(0, end));
  is_last_ = end == rest_.size();
  rest_.remove_prefix(is_last_ ? end : end + 1);
  return true;
}

std::string inp_label(std::string_view text) {
  if (is_quoted(text)) {
    return std::string(text.substr(1, text.size() - 2));
  }
  std::string label(text);
  std::erase_if(label, is_blank);
  return label;
}

std::string inp_key(std::string_view text) {
  return is_quoted(text) ? inp_label(text) : squeezed(text);
}

void fail_in_inp(const std::filesystem::path& path, std::string_view text, std::size_t offset,
                 const std::string& message) {
  TextScanner(text, path).fail_at(offset, message);
}

}  // namespace trismooth

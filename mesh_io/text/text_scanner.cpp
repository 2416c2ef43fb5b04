// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "trismooth/base/text/printable_text.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

// The classes of characters that mean something between tokens, one bit each; a table, since every byte is looked up.
constexpr unsigned blank = 1;
constexpr unsigned line_end = 2;
constexpr unsigned hash = 4;
constexpr unsigned backslash = 8;
constexpr unsigned percent = 16;

constexpr std::array<unsigned char, 256> make_classes() {
  std::array<unsigned char, 256> classes{};
  for (const char c : {' ', '\t', '\v', '\f'}) {
    classes[static_cast<unsigned char>(c)] = blank;
  }
  classes['\n'] = line_end;
  classes['\r'] = line_end;
  classes['#'] = hash;
  classes['%'] = percent;
  classes['\\'] = backslash;
  return classes;
}
constexpr std::array<unsigned char, 256> classes = make_classes();

constexpr unsigned class_of(char c) {
  return classes[static_cast<unsigned char>(c)];
}
constexpr bool is_line_end(char c) {
  return class_of(c) == line_end;
}

/// Whether the byte at `offset` is the Ctrl-Z with which DOS ended text files: only white space follows.
bool ends_text(std::string_view text, std::size_t offset) {
  constexpr char control_z = '\x1a';
  return offset < text.size() && text[offset] == control_z &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(offset) + 1, text.end(),
                     [](char c) { return (class_of(c) & (blank | line_end)) != 0; });
}

/// Lines before `offset`; CR LF counts once.
std::size_t line_at(std::string_view text, std::size_t offset) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min(offset, text.size()); ++i) {
    if (text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'))) {
      ++line;
    }
  }
  return line;
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::filesystem::path path, Comments comments, std::size_t begin,
                         Continuation continuation)
    : text_(text),
      path_(std::move(path)),
      offset_(begin),
      token_offset_(begin),
      comments_(comments),
      continuation_(continuation),
      token_ends_(blank | line_end | class_of(static_cast<char>(comments)) |
                  (continuation == Continuation::backslash ? backslash : 0)) {}

/// Bytes of the line end at `offset`: CR LF counts as one end.
std::size_t TextScanner::line_end_length(std::size_t offset) const {
  return text_[offset] == '\r' && offset + 1 < text_.size() && text_[offset + 1] == '\n' ? 2 : 1;
}

bool TextScanner::is_continuation(std::size_t offset) const {
  return continuation_ == Continuation::backslash && text_[offset] == '\\' && offset + 1 < text_.size() &&
         is_line_end(text_[offset + 1]);
}

void TextScanner::skip_blanks() {
  while (offset_ < text_.size()) {
    if (is_blank(text_[offset_])) {
      ++offset_;
    } else if (is_continuation(offset_)) {
      offset_ += 1 + line_end_length(offset_ + 1);
    } else {
      break;
    }
  }
  if (comments_ != Comments::none && offset_ < text_.size() && text_[offset_] == static_cast<char>(comments_)) {
    while (offset_ < text_.size() && !is_line_end(text_[offset_])) {
      ++offset_;
    }
  }
  if (ends_text(text_, offset_)) {
    offset_ = text_.size();
  }
}

void TextScanner::skip_space() {
  skip_blanks();
  while (offset_ < text_.size() && is_line_end(text_[offset_])) {
    ++offset_;
    skip_blanks();
  }
}

bool TextScanner::at_end() {
  skip_space();
  return offset_ == text_.size();
}

bool TextScanner::at_end_of_line() {
  skip_blanks();
  return offset_ == text_.size() || is_line_end(text_[offset_]);
}

std::string_view TextScanner::peek_token() {
  skip_space();
  std::size_t end = offset_;
  // A backslash within a line is part of its token.
  while (end < text_.size() &&
         ((class_of(text_[end]) & token_ends_) == 0 || (text_[end] == '\\' && !is_continuation(end)))) {
    ++end;
  }
  return text_.substr(offset_, end - offset_ - (end > offset_ && ends_text(text_, end - 1) ? 1 : 0));
}

std::string_view TextScanner::next_token(std::string_view what) {
  const std::string_view token = peek_token();
  token_offset_ = offset_;
  if (token.empty()) {
    fail("expected " + std::string(what) + ", got the end of the file");
  }
  offset_ += token.size();
  return token;
}

double TextScanner::next_double(std::string_view what) {
  const std::string_view token = next_token(what);
  const std::optional<double> value = parse_number<double>(token);
  if (!value || !std::isfinite(*value)) {
    fail("expected " + std::string(what) + " (a finite number), got " + quoted(token));
  }
  return *value;
}

std::int64_t TextScanner::next_integer(std::string_view what, std::int64_t lowest, std::int64_t highest) {
  const std::string_view token = next_token(what);
  const std::optional<std::int64_t> value = parse_integer(token);
  if (value && lowest <= *value && *value <= highest) {
    return *value;
  }
  // Digits beyond 64 bits are a whole number too, out of any range.
  const std::string_view digits = token.substr(token.find_first_not_of("+-") == 1 ? 1 : 0);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
    fail("expected " + std::string(what) + " (a whole number), got " + quoted(token));
  }
  fail("expected " + std::string(what) + " from " + std::to_string(lowest) + " to " + std::to_string(highest) +
       ", got " + quoted(token));
}

std::string_view TextScanner::next_line() {
  const std::size_t begin = offset_;
  token_offset_ = begin;
  while (offset_ < text_.size() && !is_line_end(text_[offset_])) {
    ++offset_;
  }
  const bool has_end_mark = offset_ > begin && ends_text(text_, offset_ - 1);
  const std::string_view line = text_.substr(begin, offset_ - begin - (has_end_mark ? 1 : 0));
  if (offset_ < text_.size()) {
    offset_ += line_end_length(offset_);
  }
  return line;
}

void TextScanner::fail(const std::string& message) const {
  fail_at(token_offset_, message);
}

void TextScanner::fail_at(std::size_t offset, const std::string& message) const {
  throw ReadError(path_, line_at(text_, offset), message);
}

void require_room(const std::filesystem::path& path, std::string_view what, std::uint64_t count,
                  std::uint64_t bytes_each, std::uint64_t available) {
  const std::uint64_t room = available / bytes_each;
  if (count > room) {
    throw ReadError(path, "declares " + std::to_string(count) + " " + std::string(what) +
                              ", but the file has room for " + std::to_string(room) +
                              " at most: it is cut off, or that number is wrong");
  }
}

std::string quoted(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  std::size_t shown = 0;
  while (!token.empty() && shown < longest) {
    const std::string_view piece = first_piece(token).bytes;
    text += printable(piece);
    shown += piece.size();
    token.remove_prefix(piece.size());
  }
  return text + (token.empty() ? "'" : "...'");
}

}  // namespace trismooth

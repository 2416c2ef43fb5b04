#include "trismooth/mesh_io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/number_text.h"

namespace trismooth {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

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

TextScanner::TextScanner(std::string_view text, std::filesystem::path path, Comments comments, std::size_t begin)
    : text_(text), path_(std::move(path)), offset_(begin), token_offset_(begin), comments_(comments) {}

void TextScanner::skip_blanks() {
  while (offset_ < text_.size() && is_blank(text_[offset_])) {
    ++offset_;
  }
  if (comments_ == Comments::hash && offset_ < text_.size() && text_[offset_] == '#') {
    while (offset_ < text_.size() && !is_line_end(text_[offset_])) {
      ++offset_;
    }
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
  while (end < text_.size() && !is_blank(text_[end]) && !is_line_end(text_[end]) &&
         !(comments_ == Comments::hash && text_[end] == '#')) {
    ++end;
  }
  return text_.substr(offset_, end - offset_);
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

float TextScanner::next_float(std::string_view what) {
  const std::string_view token = next_token(what);
  const std::optional<float> value = parse_number<float>(token);
  if (!value || !std::isfinite(*value)) {
    fail("expected " + std::string(what) + " (a finite float32 number), got " + quoted(token));
  }
  return *value;
}

std::int64_t TextScanner::next_integer(std::string_view what, std::int64_t lowest, std::int64_t highest) {
  const std::string_view token = next_token(what);
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-';
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(token.data() + (plus ? 1 : 0), token.data() + token.size(), value);
  if (stop != token.data() + token.size() || error == std::errc::invalid_argument) {
    fail("expected " + std::string(what) + " (a whole number), got " + quoted(token));
  }
  if (error == std::errc::result_out_of_range || value < lowest || value > highest) {
    fail("expected " + std::string(what) + " from " + std::to_string(lowest) + " to " + std::to_string(highest) +
         ", got " + quoted(token));
  }
  return value;
}

std::string_view TextScanner::next_line() {
  const std::size_t begin = offset_;
  token_offset_ = begin;
  while (offset_ < text_.size() && !is_line_end(text_[offset_])) {
    ++offset_;
  }
  const std::string_view line = text_.substr(begin, offset_ - begin);
  if (offset_ < text_.size()) {
    const bool crlf = text_[offset_] == '\r' && offset_ + 1 < text_.size() && text_[offset_ + 1] == '\n';
    offset_ += crlf ? 2 : 1;
  }
  return line;
}

void TextScanner::fail(const std::string& message) const {
  throw ReadError(path_, line_at(text_, token_offset_), message);
}

void require_room(const std::filesystem::path& path, std::string_view what, std::uint64_t count,
                  std::uint64_t bytes_each, std::uint64_t available) {
  const std::uint64_t room = available / bytes_each;
  if (count > room) {
    throw ReadError(path, "declares " + std::to_string(count) + " " + std::string(what) +
                              ", but the file has room for " + std::to_string(room) + " at most");
  }
}

std::string quoted(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : token.substr(0, longest)) {
    text += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
  }
  return text + (token.size() > longest ? "...'" : "'");
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace trismooth {

/// What some editors put in front of text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Where a text begins: behind the byte order mark that some editors put in front of it, if it has one.
constexpr std::size_t begin_of_text(std::string_view bytes) {
  return bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
}

/// Reads the white-space separated tokens of a text file and knows where it stands, for messages with a line number.
/// LF, CR LF and CR alone end a line; a Ctrl-Z with nothing but white space behind it ends the text.
/// Locale-independent. The text must outlive the scanner.
class TextScanner {
 public:
  /// The character that starts a comment, which runs to the end of the line.
  enum class Comments : char { none = '\0', hash = '#', percent = '%' };
  enum class Continuation : bool { none, backslash };  ///< backslash: one that ends a line makes that end a blank

  /// Scans text[begin, end of text); line numbers count from the start of `text`.
  TextScanner(std::string_view text, std::filesystem::path path, Comments comments = Comments::none,
              std::size_t begin = 0, Continuation continuation = Continuation::none);

  /// True where nothing but white space and comments is left.
  bool at_end();
  /// True where nothing but blanks and comments is left on this line (or in the file).
  bool at_end_of_line();

  /// The next token, across lines; fails at the end of the file: "expected <what>, got the end of the file".
  std::string_view next_token(std::string_view what);
  /// The next token without reading it; empty at the end of the file.
  std::string_view peek_token();
  /// The next token as a finite number (digits, optional sign, fraction, exponent); fails on anything else, on NaN,
  /// on an infinity and on a value beyond the range. Values below the range are 0.
  double next_double(std::string_view what);
  /// The next token as a whole number within [lowest, highest]; fails on anything else.
  std::int64_t next_integer(std::string_view what, std::int64_t lowest, std::int64_t highest);

  /// The rest of this line as it is, comments and continuations too, without its end; stands at the next line then.
  std::string_view next_line();

  /// Byte offset of the token that was read last / of the next byte to read.
  std::size_t token_offset() const { return token_offset_; }
  std::size_t offset() const { return offset_; }
  void seek(std::size_t offset) { offset_ = offset; }
  /// Goes on at `offset`; the token at `token_offset` counts as the one that was read last.
  void resume(std::size_t token_offset, std::size_t offset) {
    token_offset_ = token_offset;
    offset_ = offset;
  }
  std::string_view text() const { return text_; }
  const std::filesystem::path& path() const { return path_; }

  /// Throws ReadError at the line of the token that was read last.
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws ReadError at the line of the byte at `offset`.
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

 private:
  void skip_space();
  void skip_blanks();
  bool is_continuation(std::size_t offset) const;
  std::size_t line_end_length(std::size_t offset) const;

  std::string_view text_;
  std::filesystem::path path_;
  std::size_t offset_;
  std::size_t token_offset_;
  Comments comments_;
  Continuation continuation_;
  unsigned token_ends_;  ///< the classes of characters that may end a token
};

/// `count` elements that take at least `bytes_each` bytes of text or data: fails where `available` bytes cannot hold
/// them ("declares 2000000000 vertices, but the file has room for 12 at most"). For checks before any allocation.
void require_room(const std::filesystem::path& path, std::string_view what, std::uint64_t count,
                  std::uint64_t bytes_each, std::uint64_t available);

/// A token for messages: quoted, cut after 40 bytes and the character that they end in, and printable().
std::string quoted(std::string_view token);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// Reads a text as Fortran's list-directed input does, a statement a line: numbers separated by blanks or a comma, with
/// exponents as Fortran writes them; lines of blanks are passed, and what stands behind the numbers that are asked for
/// says nothing. A comma that may be meant as a decimal point is refused.
class ListDirectedLines {
 public:
  /// Reads on where the scanner stands, which must outlive the object.
  explicit ListDirectedLines(TextScanner& scanner) : scanner_(scanner) {}

  /// Goes to the next line that is not blank, as after end_line(); fails at the end of the file: "expected <what>, got
  /// the end of the file".
  void next_line(std::string_view what);

  /// The next value of the line. Fails where the line ends or says anything else.
  std::int64_t next_integer(std::string_view what, std::int64_t lowest, std::int64_t highest);
  double next_number(std::string_view what);
  /// The next number of the line, or not-a-number, which stands for no value.
  double next_number_or_none(std::string_view what);

  /// The next value of the line if it is a whole number; nothing, and nothing passed, if it is anything else.
  std::optional<std::int64_t> next_integer_if_any();

  /// To be called behind the last line: fails where one more number follows, separated otherwise than those that were
  /// read: "1.5,0" and "1,5 0" may be decimal commas.
  void end_line() const;

  /// Byte offset of the value that was read last.
  std::size_t value_offset() const { return value_offset_; }

  /// Throws ReadError at the line of that value.
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail_at(value_offset_, message); }

 private:
  std::string_view next_value(std::string_view what);
  std::string_view peek_value(std::size_t& begin) const;
  void take_value(std::size_t begin, std::string_view value);
  void require_one_separator(std::size_t begin);

  TextScanner& scanner_;
  std::string_view line_;
  std::size_t line_offset_ = 0;
  std::size_t at_ = 0;       ///< in the line
  bool has_blanks_ = false;  ///< between values of the line, without a comma
  bool has_commas_ = false;
  std::size_t value_offset_ = 0;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// A line of a 2dm file: a card, and the words that follow, one of which may stand in quotation marks. '#' begins a
/// comment outside of these.
class SmsLine {
 public:
  /// The scanner's next line. The scanner must outlive the object.
  explicit SmsLine(TextScanner& scanner);

  /// The next word, without its quotation marks; nothing at the end of the line.
  std::optional<std::string_view> next_word();
  /// The next word as a number; fails where there is none.
  std::int64_t next_integer(std::string_view what);
  double next_number(std::string_view what);
  /// The next word as a number, or not-a-number, which stands for no value.
  double next_number_or_none(std::string_view what);

  /// Whether the word that was read last stood in quotation marks.
  bool is_quoted() const { return is_quoted_; }
  /// Byte offsets of the word that was read last, and of the line.
  std::size_t word_offset() const { return word_offset_; }
  std::size_t offset() const { return offset_; }

  /// Throws ReadError at the line.
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail_at(offset_, message); }

 private:
  std::string_view require_word(std::string_view what);

  TextScanner& scanner_;
  std::size_t offset_;
  std::string_view line_;
  std::size_t at_ = 0;  ///< in the line
  std::size_t word_offset_ = 0;
  bool is_quoted_ = false;
};

}  // namespace trismooth

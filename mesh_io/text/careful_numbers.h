// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// Numbers as a TextScanner reads them, one by one, which throws ReadError and says what is wrong where PlainNumbers
/// answer false: a function that reads a row takes either, so that what a row means is written once.
class CarefulNumbers {
 public:
  /// Reads on where the scanner stands, which must outlive the object.
  explicit CarefulNumbers(TextScanner& scanner) : scanner_(scanner) {}

  /// The next finite number; `what` it is, for messages.
  bool next_real(double& value, std::string_view what) {
    value = scanner_.next_double(what);
    return true;
  }

  /// The next whole number, from `lowest` to `highest`.
  template <class T>
  bool next_whole(T& value, std::string_view what, std::int64_t lowest = std::numeric_limits<T>::min(),
                  std::int64_t highest = std::numeric_limits<T>::max()) {
    value = static_cast<T>(scanner_.next_integer(what, lowest, highest));
    return true;
  }

  /// The next whole number, from `lowest` to `highest`; wrong(token) is the message on another token.
  template <class T, class Wrong>
  bool next_index(T& value, std::string_view what, std::int64_t lowest, std::int64_t highest, const Wrong& wrong) {
    const std::string_view token = scanner_.next_token(what);
    const auto number = parse_integer(token);
    if (!number || *number < lowest || *number > highest) {
      scanner_.fail(wrong(token));
    }
    value = static_cast<T>(*number);
    return true;
  }

  bool at_end_of_line() { return scanner_.at_end_of_line(); }
  /// Byte offset of the number that was read last.
  std::size_t token_offset() const { return scanner_.token_offset(); }

  /// Throws ReadError at the line of that number; message(it, as it is written) is what is wrong.
  template <class Message>
  [[noreturn]] bool fail(const Message& message) const {
    scanner_.fail(message(scanner_.text().substr(token_offset(), scanner_.offset() - token_offset())));
  }

  /// Throws ReadError at the line of the next token, where `what` is expected; message(token) is what is wrong with it.
  template <class Message>
  [[noreturn]] bool fail_at_next(std::string_view what, const Message& message) {
    const std::string_view token = scanner_.next_token(what);
    scanner_.fail(message(token));
  }

 private:
  TextScanner& scanner_;
};

/// Calls read_row(numbers, row) for rows first to last - 1; false where one of them could not be read.
template <class ReadRow>
bool read_plain_part(PlainNumbers& numbers, std::size_t first, std::size_t last, const ReadRow& read_row) {
  bool plain = true;
  for (std::size_t row = first; row < last && plain; ++row) {
    plain = read_row(numbers, row);
  }
  return plain;
}

/// Reads `count` rows of `columns` numbers each from where the scanner stands, which is behind them then. Calls
/// read_row(numbers, row) for each: with PlainNumbers, for parts of them, by all workers, or, where it answers false
/// for any, with CarefulNumbers for one after another. Throws ReadError, also where the text ends before:
/// "expected 5 <things>, got 3<remark>", or what the row misses where there is no name for things.
template <class ReadRow>
void read_rows(PlainRows& plain, TextScanner& scanner, std::size_t count, std::size_t columns, std::string_view things,
               const ReadRow& read_row, std::string_view remark = {}) {
  const auto end = count == 0 ? std::nullopt
                              : plain.read(scanner.offset(), count, columns,
                                           [&read_row](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                                             return read_plain_part(numbers, first, last, read_row);
                                           });
  if (end) {
    scanner.resume(end->last_number, end->offset);
    return;
  }
  CarefulNumbers numbers(scanner);
  for (std::size_t row = 0; row < count; ++row) {
    if (!things.empty() && scanner.at_end()) {
      scanner.fail("expected " + std::to_string(count) + " " + std::string(things) + ", got " + std::to_string(row) +
                   std::string(remark));
    }
    read_row(numbers, row);
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"

namespace trismooth {

/// Reads a legacy VTK file from front to back: keywords, then the values that a keyword announces, by the same calls
/// for ASCII files and for BINARY ones (keywords as text, values big-endian). A byte-order mark may stand in front.
/// Comments are known to no version of VTK, but some programs write them: from a '#' that begins a token to the end of
/// its line, where a keyword or a number of a text may stand or behind the header of values. Everything that fails
/// throws ReadError with the line (ASCII) or byte offset (BINARY) of what was read last. The bytes must outlive the
/// input.
class VtkLegacyInput {
 public:
  /// Reads the header: version, title, encoding. Stands before the DATASET keyword then.
  VtkLegacyInput(std::string_view bytes, const std::filesystem::path& path, const FileWorkers& workers);

  bool is_binary() const { return binary_; }
  std::string_view bytes() const { return scanner_.text(); }

  /// True where nothing but white space and comments is left.
  bool at_end();
  /// True where nothing but blanks and a comment is left on this line.
  bool at_end_of_line();

  /// The next token in lower case (its first characters, where it is longer than any keyword); empty at the end of the
  /// file. The input stays where it is, before any white space: that may belong to binary data.
  std::string peek_keyword();
  /// True where the keyword is the next token, or the token behind it. In BINARY files data may stand in the next line:
  /// comments are looked for in this one only.
  bool is_next(std::string_view keyword);
  bool is_after_next(std::string_view keyword);
  /// Passes lines that are comments; stands before any white space then.
  void pass_comments();
  /// The next token, past any comments; fails at the end of the file.
  std::string_view next_keyword(std::string_view what);
  /// The next token; fails at the end of the file: "expected <what>, got the end of the file".
  std::string_view next_token(std::string_view what);
  /// The next token, decoded.
  std::string next_name(std::string_view what) { return decode_vtk_name(next_token(what)); }
  /// The next token as the name of a type; fails on an unknown one.
  VtkLegacyType next_type();
  /// The next token as a whole number from 0 to 2^63 - 1; fails on anything else.
  std::uint64_t next_count(std::string_view what);
  /// Reads the keyword `keyword` (lower case); fails on anything else.
  void expect_keyword(std::string_view keyword);

  /// Stands before `count` values, of `bytes_each` in BINARY files: fails where the rest of the file cannot hold them,
  /// and passes the end of the header line before BINARY data.
  void begin_values(std::uint64_t count, std::size_t bytes_each, std::string_view what);
  /// Byte offset of what is read next, before any white space.
  std::size_t offset() const { return scanner_.offset(); }
  /// Byte offset of the token or value that was read last.
  std::size_t token_offset() const { return binary_ ? place_ : scanner_.token_offset(); }
  /// Passes what is left of the line, if that is a comment.
  void pass_comment();
  /// begin_values(), then all of them. `each` is what one of them is called, `what` if it is empty.
  template <class T>
  std::vector<T> read_values(std::uint64_t count, std::string_view what, std::string_view each = {});
  /// begin_values(), then all of them as single bits, 0 and 1: eight a byte in BINARY files, the first one in the
  /// highest bit.
  std::vector<std::uint8_t> read_bits(std::uint64_t count, std::string_view what);

  // It is careful numbers itself (see PlainSource).
  static constexpr bool is_plain = false;
  /// The next value. In ASCII files any white space may stand before it, integers are checked for their range, and
  /// numbers of floating point may be infinite or NaN.
  template <class T>
  bool next(T& value, std::string_view what);
  /// Fails with the message, which is not told the number.
  template <std::invocable<std::string_view> Message>
  [[noreturn]] bool fail(const Message& message) const {
    fail(message(std::string_view()));
  }
  /// Reads rows of `columns` numbers (0: not of as many each) by body(numbers, first, last), which reads rows first to
  /// last - 1 and answers as the numbers do: in parts, by all workers, where an ASCII file has plain ones (see
  /// PlainRows), else all of them from here. Integers that the body reads as those of 64 bits are of the type `stored`
  /// in BINARY files. Behind begin_values().
  template <class Body>
  void read_rows(std::uint64_t rows, std::uint64_t columns, const Body& body, ScalarType stored = ScalarType::int64) {
    const bool may_be_plain = !binary_ && rows > 0 && columns > 0;
    if (const auto end = may_be_plain ? plain_rows_.read(scanner_.offset(), rows, columns, body) : std::nullopt) {
      scanner_.resume(end->last_number, end->offset);
    } else {
      stored_ = stored;
      body(*this, std::size_t{0}, rows);
    }
  }
  /// Who shares the work.
  Workers& workers() const { return workers_; }

  /// Reads `count` strings: one a line in ASCII files, behind their length in BINARY ones. Views of the bytes as they
  /// are, in ASCII files encoded.
  std::vector<std::string_view> read_strings(std::uint64_t count, std::string_view what);
  /// Passes `count` variants: the number of a type and a text each, as text in both encodings.
  void skip_variants(std::uint64_t count, std::string_view what);
  /// The METADATA block of an array of `components`, if there is one: it ends at an empty line or with the file. Null
  /// where it says nothing. Fails where the names of the components are cut off.
  std::shared_ptr<const ArrayDescription> read_metadata(std::uint64_t components);

  /// a * b values, declared by two numbers of the file; fails where the product has more than 64 bits.
  std::uint64_t value_count(std::uint64_t a, std::uint64_t b, std::string_view what) const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  void read_header();
  std::uint64_t bytes_left() const { return scanner_.text().size() - scanner_.offset(); }
  void require_values(std::uint64_t count, std::uint64_t room, std::string_view what) const;
  void pass_header_line();
  std::string peek_word();
  void read_information(const std::vector<std::string_view>& header, std::vector<ArrayInformation>& information);
  template <class T>
  T next_text_value(std::string_view what);
  template <class T>
  T next_binary_value(std::string_view what);
  std::uint64_t next_string_length(std::string_view what);

  TextScanner scanner_;
  Workers& workers_;
  PlainRows plain_rows_;
  bool binary_ = false;
  ScalarType stored_ = ScalarType::int64;  ///< see read_rows()
  std::size_t place_ = 0;                  ///< byte offset of the token or BINARY value that was read last
};

}  // namespace trismooth

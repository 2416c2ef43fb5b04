// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trismooth/mesh_io/bytes/binary_list_rows.h"
#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/ply/ply_header.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

// The rows of a PLY file, number by number. Both encodings have the same interface, so that one reader serves both.

/// A number of a PLY file.
struct PlyNumber {
  double value = 0;        ///< exact but for 64-bit integers, which may be rounded
  std::int64_t whole = 0;  ///< the value of an integer type, exact; of uint64 less 2^64 where it is 2^63 or more

  /// The digits of a number of an integer type.
  std::string text() const {
    return value < 0 ? std::to_string(whole) : std::to_string(static_cast<std::uint64_t>(whole));
  }
};

/// True where the bytes are white space and zeros alone.
inline bool is_padding(std::string_view bytes) {
  constexpr std::string_view padding(" \t\v\f\r\n\0", 7);
  return bytes.find_first_not_of(padding) == bytes.npos;
}

/// The rows of an ASCII file. A row may run over several lines, but the next row begins on a new one.
class PlyTextSource {
 public:
  PlyTextSource(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                const FileWorkers& workers)
      : scanner_(bytes, path, TextScanner::Comments::none, begin), workers_(workers), plain_rows_(bytes, workers) {}

  /// The fewest bytes that a number takes: a digit and the space after it.
  static std::uint64_t least_bytes(ScalarType /*type*/) { return 2; }
  /// The bytes that are left for numbers, the space after the last one included though it may be missing.
  std::uint64_t room() const { return scanner_.text().size() - scanner_.offset() + 1; }

  /// True where no number is left.
  bool at_end() { return scanner_.at_end(); }
  /// True where nothing but white space and zeros is left.
  bool at_padding() const { return is_padding(scanner_.text().substr(scanner_.offset())); }
  std::size_t offset() const { return scanner_.offset(); }

  /// The next number, of type `type`; integers are checked against the type's range, floating-point numbers may be
  /// infinite or NaN. `label` names it in messages.
  PlyNumber number(ScalarType type, std::string_view label) {
    return visit_scalar_type(type, [&](auto zero) -> PlyNumber {
      using T = decltype(zero);
      if constexpr (std::is_floating_point_v<T>) {
        const std::string_view token = scanner_.next_token(label);
        const auto value = parse_number<T>(token);
        if (!value) {
          scanner_.fail("expected " + std::string(label) + " (a number), got " + quoted(token));
        }
        return {static_cast<double>(*value)};
      } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        const std::string_view token = scanner_.next_token(label);
        const auto value = parse_unsigned(token);
        if (!value) {
          scanner_.fail("expected " + std::string(label) + " (a whole number from 0 to 18446744073709551615), got " +
                        quoted(token));
        }
        return {static_cast<double>(*value), static_cast<std::int64_t>(*value)};
      } else {
        const std::int64_t value =
            scanner_.next_integer(label, std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
        return {static_cast<double>(value), value};
      }
    });
  }

  /// Byte offset of the number that was read last.
  std::size_t number_offset() const { return scanner_.token_offset(); }

  void skip(ScalarType /*type*/, std::uint64_t count, std::string_view label) {
    for (std::uint64_t i = 0; i < count; ++i) {
      scanner_.next_token(label);
    }
  }

  /// True where a row may end: nothing but the next row's line follows.
  bool at_row_end() { return scanner_.at_end_of_line(); }

  /// Whether rows are to be read in parts, if they are plain.
  bool reads_parts() const { return workers_.part_bytes != FileWorkers::serial; }
  /// A reader of plain numbers from here on, which moves nothing here.
  PlainNumbers plain_numbers() const { return {scanner_.text(), scanner_.offset()}; }

  /// Reads `rows` rows of as many numbers as there are `types` (see PlainRows::read) and stands behind them; false
  /// where that fails.
  template <class Body>
  bool read_plain_rows(std::size_t rows, std::span<const ScalarType> types, const Body& body) {
    const auto end = plain_rows_.read(scanner_.offset(), rows, types.size(), body);
    if (end) {
      resume(*end);
    }
    return end.has_value();
  }

  /// The rows of an element with one list, at that position; each on a line.
  PlainListRows find_plain_lists(const PlyElement& element, std::size_t /*list*/) const {
    return {scanner_.text(), scanner_.offset(), element.count, element.properties.size() - 1, workers_};
  }
  void resume(const PlainRows::End& end) { scanner_.resume(end.last_number, end.offset); }

  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner scanner_;
  FileWorkers workers_;
  PlainRows plain_rows_;
};

/// The rows of a binary file of either byte order.
class PlyBinarySource {
 public:
  PlyBinarySource(std::filesystem::path path, std::string_view bytes, std::size_t begin, NumberEncoding encoding,
                  const FileWorkers& workers)
      : path_(std::move(path)),
        bytes_(bytes),
        workers_(workers),
        offset_(begin),
        number_offset_(begin),
        swapped_((encoding == NumberEncoding::big_endian) == (std::endian::native == std::endian::little)) {}

  static std::uint64_t least_bytes(ScalarType type) { return size_of(type); }
  std::uint64_t room() const { return bytes_.size() - offset_; }

  bool at_end() const { return offset_ == bytes_.size(); }
  bool at_padding() const { return is_padding(bytes_.substr(offset_)); }
  std::size_t offset() const { return offset_; }

  PlyNumber number(ScalarType type, std::string_view label) {
    return visit_scalar_type(type, [&](auto zero) -> PlyNumber {
      number_offset_ = offset_;
      auto number = zero;
      if (!plain_numbers().next(number)) {
        fail("expected " + std::string(label) + ", got the end of the file");
      }
      offset_ += sizeof(number);
      if constexpr (std::is_floating_point_v<decltype(zero)>) {
        return {static_cast<double>(number)};
      } else {
        return {static_cast<double>(number), static_cast<std::int64_t>(number)};
      }
    });
  }

  std::size_t number_offset() const { return number_offset_; }

  void skip(ScalarType type, std::uint64_t count, std::string_view label) {
    if (room() / size_of(type) < count) {
      fail("expected " + std::to_string(count) + " numbers of " + std::string(label) + ", got the end of the file");
    }
    offset_ += count * size_of(type);
  }

  bool at_row_end() const { return true; }

  bool reads_parts() const { return workers_.part_bytes != FileWorkers::serial; }
  BinaryNumbers plain_numbers() const { return {bytes_, offset_, swapped_}; }

  /// Reads `rows` rows of numbers of the `types`, for which there is room, as PlyTextSource does.
  template <class Body>
  bool read_plain_rows(std::size_t rows, std::span<const ScalarType> types, const Body& body) {
    std::size_t row_bytes = 0;
    for (const ScalarType type : types) {
      row_bytes += size_of(type);
    }
    std::size_t last_number = 0;  // set by the one block that holds the last row
    const bool plain = all_file_blocks(workers_, rows, row_bytes, [&](std::size_t first, std::size_t last) {
      BinaryNumbers numbers(bytes_, offset_ + first * row_bytes, swapped_);
      const bool read = body(numbers, first, last);
      if (last == rows) {
        last_number = numbers.token_offset();
      }
      return read;
    });
    if (plain) {
      resume({last_number, offset_ + rows * row_bytes});
    }
    return plain;
  }

  BinaryListRows find_plain_lists(const PlyElement& element, std::size_t list) const {
    BinaryListLayout layout{.rows = element.count,
                            .length_type = *element.properties[list].count_type,
                            .item_bytes = size_of(element.properties[list].type),
                            .swapped = swapped_};
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (p != list) {
        (p < list ? layout.bytes_before : layout.bytes_behind) += size_of(element.properties[p].type);
      }
    }
    return {bytes_, offset_, layout, workers_};
  }
  void resume(const PlainRows::End& end) {
    number_offset_ = end.last_number;
    offset_ = end.offset;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(path_, "byte " + std::to_string(number_offset_) + ": " + message);
  }

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
  FileWorkers workers_;
  std::size_t offset_;
  std::size_t number_offset_;
  bool swapped_;
};

}  // namespace trismooth

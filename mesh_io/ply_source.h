#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/number_text.h"
#include "trismooth/mesh_io/ply_header.h"
#include "trismooth/mesh_io/text_scanner.h"

namespace trismooth {

// The rows of a PLY file, number by number. Both encodings have the same interface, so that one reader serves both;
// every PLY type is exact in a double.

/// The rows of an ASCII file. A row may run over several lines, but the next row begins on a new one.
class PlyTextSource {
 public:
  PlyTextSource(const std::filesystem::path& path, std::string_view bytes, std::size_t begin)
      : scanner_(bytes, path, TextScanner::Comments::none, begin) {}

  /// The fewest bytes that a number takes: a digit and the space after it.
  static std::uint64_t least_bytes(ScalarType /*type*/) { return 2; }
  /// The bytes that are left for numbers, the space after the last one included though it may be missing.
  std::uint64_t room() const { return scanner_.text().size() - scanner_.offset() + 1; }

  /// True where no number is left.
  bool at_end() { return scanner_.at_end(); }
  std::size_t offset() const { return scanner_.offset(); }

  /// The next number, of type `type`; integers are checked against the type's range, floating-point numbers may be
  /// infinite or NaN. `label` names it in messages.
  double number(ScalarType type, std::string_view label) {
    return visit_scalar_type(type, [&](auto zero) -> double {
      using T = decltype(zero);
      if constexpr (std::is_floating_point_v<T>) {
        const std::string_view token = scanner_.next_token(label);
        const auto value = parse_number<T>(token);
        if (!value) {
          scanner_.fail("expected " + std::string(label) + " (a number), got " + quoted(token));
        }
        return static_cast<double>(*value);
      } else {
        // The 64-bit types, which PLY lacks, make this instantiation only.
        constexpr auto highest = static_cast<std::int64_t>(
            std::min<std::uint64_t>(std::numeric_limits<T>::max(), std::numeric_limits<std::int64_t>::max()));
        return static_cast<double>(
            scanner_.next_integer(label, static_cast<std::int64_t>(std::numeric_limits<T>::min()), highest));
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

  /// Fails where a number follows.
  void refuse_more_rows() {
    const std::string_view token = scanner_.next_token("the end of the file");
    if (parse_number<double>(token)) {
      scanner_.fail("expected the end of the file after the rows that the header declares, got " + quoted(token));
    }
    scanner_.seek(scanner_.token_offset());
  }

  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner scanner_;
};

/// The rows of a binary file of either byte order.
class PlyBinarySource {
 public:
  PlyBinarySource(std::filesystem::path path, std::string_view bytes, std::size_t begin, CoordinateEncoding encoding)
      : path_(std::move(path)),
        bytes_(bytes),
        offset_(begin),
        number_offset_(begin),
        swapped_((encoding == CoordinateEncoding::big_endian) == (std::endian::native == std::endian::little)) {}

  static std::uint64_t least_bytes(ScalarType type) { return size_of(type); }
  std::uint64_t room() const { return bytes_.size() - offset_; }

  bool at_end() const { return offset_ == bytes_.size(); }
  std::size_t offset() const { return offset_; }

  double number(ScalarType type, std::string_view label) {
    return visit_scalar_type(type, [&](auto zero) -> double {
      std::array<char, sizeof(zero)> stored{};
      number_offset_ = offset_;
      if (room() < stored.size()) {
        fail("expected " + std::string(label) + ", got the end of the file");
      }
      std::memcpy(stored.data(), bytes_.data() + offset_, stored.size());
      if (swapped_) {
        std::ranges::reverse(stored);
      }
      offset_ += stored.size();
      return static_cast<double>(std::bit_cast<decltype(zero)>(stored));
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

  /// Fails where anything but white space or zeros follows.
  void refuse_more_rows() {
    constexpr std::string_view padding(" \t\v\f\r\n\0", 7);
    if (bytes_.find_first_not_of(padding, offset_) != bytes_.npos) {
      number_offset_ = offset_;
      fail("expected the end of the file after the rows that the header declares, got " + std::to_string(room()) +
           " bytes more");
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(path_, "byte " + std::to_string(number_offset_) + ": " + message);
  }

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
  std::size_t offset_;
  std::size_t number_offset_;
  bool swapped_;
};

}  // namespace trismooth

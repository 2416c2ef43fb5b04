// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// Of an int of the file.
inline constexpr std::int64_t largest_msh_int = std::numeric_limits<std::int32_t>::max();

/// What the section $MeshFormat says; files of version 1 have none.
struct MshHeader {
  int version = 10;  ///< ten times the version: 10, 20 to 22, 40, 41
  bool binary = false;
  bool swapped = false;        ///< binary numbers are not in this machine's byte order
  std::size_t size_bytes = 8;  ///< of a count (size_t); 4 or 8

  bool is_big_endian() const { return swapped == (std::endian::native == std::endian::little); }
  NumberEncoding encoding() const {
    return !binary           ? NumberEncoding::text
           : is_big_endian() ? NumberEncoding::big_endian
                             : NumberEncoding::little_endian;
  }
};

/// The numbers of an MSH file one by one, as text or binary, and what is said of those that are not there. The bytes
/// must outlive it.
class MshInput {
 public:
  MshInput(std::string_view bytes, const std::filesystem::path& path);

  const MshHeader& header() const { return header_; }
  std::string_view bytes() const { return scanner_.text(); }
  const std::filesystem::path& path() const { return scanner_.path(); }
  /// For what is text in binary files too.
  TextScanner& text() { return scanner_; }

  /// Reads what follows the line $MeshFormat, up to its end.
  void read_header();

  /// The next int or size_t of the file; fails on anything beyond the limits.
  std::int64_t integer(std::string_view what, std::int64_t lowest, std::int64_t highest);
  std::int64_t size(std::string_view what, std::int64_t highest = std::numeric_limits<std::int64_t>::max());
  /// The next number of floating point, finite.
  double real(std::string_view what);

  // As CarefulNumbers have them: a function that reads a row takes these too.
  bool next_real(double& value, std::string_view what) {
    value = real(what);
    return true;
  }
  template <class T>
  bool next_whole(T& value, std::string_view what, std::int64_t lowest, std::int64_t highest) {
    value = static_cast<T>(integer(what, lowest, highest));
    return true;
  }
  std::size_t token_offset() const { return number_offset(); }
  template <std::invocable<std::string_view> Message>
  [[noreturn]] bool fail(const Message& message) const {
    fail_at(number_offset(), message(std::string_view()));
  }

  /// Fails unless there is room for that many things of so many numbers and bytes at least.
  void require_room(std::string_view what, std::uint64_t count, std::size_t numbers_each, std::size_t bytes_each);

  std::size_t offset() const { return scanner_.offset(); }
  /// Of the number that was read last.
  std::size_t number_offset() const { return scanner_.token_offset(); }
  void seek(std::size_t offset) { scanner_.resume(offset, offset); }
  std::size_t bytes_left() const { return bytes().size() - offset(); }

  /// Throws ReadError at the number that was read last.
  [[noreturn]] void fail(const std::string& message) const { fail_at(number_offset(), message); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

 private:
  template <class T>
  T binary(std::string_view what);
  std::int64_t within(std::string_view what, std::int64_t value, std::int64_t lowest, std::int64_t highest) const;

  TextScanner scanner_;
  MshHeader header_;
};

}  // namespace trismooth

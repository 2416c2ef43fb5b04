// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/text/plain_source.h"

namespace trismooth {

/// Reads numbers of either byte order, one behind the other, with the interface of PlainNumbers. Inline, since meshes
/// hold millions of numbers. The bytes must outlive the reader.
class BinaryNumbers : public PlainSource {
 public:
  /// Reads from `offset` on.
  BinaryNumbers(std::string_view bytes, std::size_t offset, bool swapped)
      : bytes_(bytes), offset_(offset), number_offset_(offset), swapped_(swapped) {}

  /// The next number; false where the bytes end before.
  template <class T>
  bool next(T& value, std::string_view /*what*/ = {}) {
    number_offset_ = offset_;
    if (bytes_.size() - offset_ < sizeof(T)) {
      return false;
    }
    std::memcpy(&value, bytes_.data() + offset_, sizeof(T));
    offset_ += sizeof(T);
    if (swapped_) {
      value = with_bytes_reversed(value);
    }
    return true;
  }

  /// As many as there are values; false where the bytes end before.
  template <class T, std::size_t count>
  bool next_all(std::span<T, count> values) {
    number_offset_ = offset_;
    if ((bytes_.size() - offset_) / sizeof(T) < values.size()) {
      return false;
    }
    if (!values.empty()) {
      std::memcpy(values.data(), bytes_.data() + offset_, values.size_bytes());
    }
    offset_ += values.size_bytes();
    if (swapped_) {
      for (T& value : values) {
        value = with_bytes_reversed(value);
      }
    }
    return true;
  }

  // As PlainNumbers have them, for functions that read a row of either.
  bool next_real(double& value, std::string_view /*what*/) { return next(value) && std::isfinite(value); }
  template <class T>
  bool next_whole(T& value, std::string_view /*what*/, std::int64_t lowest, std::int64_t highest) {
    return next(value) && lowest <= value && value <= highest;
  }

  /// A row may end anywhere.
  static bool at_end_of_line() { return true; }

  /// Byte offset of the number that was read last / of what is read next.
  std::size_t token_offset() const { return number_offset_; }
  std::size_t offset() const { return offset_; }

 private:
  std::string_view bytes_;
  std::size_t offset_;
  std::size_t number_offset_;
  bool swapped_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

/// The records of an unformatted Fortran file, each between two counts of its bytes, one behind the other. Throws
/// ReadError, which names the file and what is read. The bytes outlive the object.
class SelafinRecords {
 public:
  SelafinRecords(const std::filesystem::path& path, std::string_view bytes, bool big_endian)
      : path_(path), bytes_(bytes), big_endian_(big_endian) {}

  bool at_end() const { return offset_ == bytes_.size(); }

  /// The bytes of the next record, `what` in messages.
  std::string_view next(const std::string& what) {
    const auto stated = bytes_.size() - offset_ < marker ? -1 : load_number<std::int32_t>(bytes_.substr(offset_));
    const auto left = static_cast<std::int64_t>(bytes_.size() - offset_) - 2 * static_cast<std::int64_t>(marker);
    if (stated < 0 || stated > left) {
      fail("ends before its " + what + " does, or is damaged there");
    }
    const auto size = static_cast<std::size_t>(stated);
    const std::string_view record = bytes_.substr(offset_ + marker, size);
    if (load_number<std::int32_t>(bytes_.substr(offset_ + marker + size)) != stated) {
      fail("has two counts of bytes around its " + what + " that differ: it is damaged");
    }
    offset_ += size + 2 * marker;
    return record;
  }

  /// Of a record that is to have `count` numbers of these bytes each. No product of file's numbers overflows: both are
  /// below 2^31.
  std::string_view next(const std::string& what, std::uint64_t count, std::size_t size) {
    const std::string_view record = next(what);
    if (record.size() != count * size) {
      fail("has " + std::to_string(record.size()) + " bytes of " + what + ", expected " + std::to_string(count * size));
    }
    return record;
  }

  std::vector<std::int32_t> integers(const std::string& what, std::uint64_t count) {
    const std::string_view record = next(what, count, sizeof(std::int32_t));
    std::vector<std::int32_t> numbers(record.size() / sizeof(std::int32_t));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = load_number<std::int32_t>(record.substr(i * sizeof(std::int32_t)));
    }
    return numbers;
  }

  /// The number that the text begins with.
  template <class T>
  T load_number(std::string_view text) const {
    return big_endian_ ? load<std::endian::big, T>(text.data()) : load<std::endian::little, T>(text.data());
  }

  /// Where a record that was read begins in the file.
  std::size_t offset_of(std::string_view record) const {
    return static_cast<std::size_t>(record.data() - bytes_.data());
  }

  [[noreturn]] void fail(const std::string& message) const { throw ReadError(path_, message); }

 private:
  static constexpr std::size_t marker = sizeof(std::int32_t);

  const std::filesystem::path& path_;
  std::string_view bytes_;
  bool big_endian_;
  std::size_t offset_ = 0;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// The types of a netCDF file's values, by their numbers in it; other: strings, and types of a file's own.
enum class NetcdfType : std::uint8_t {
  other = 0,
  int8 = 1,
  text = 2,
  int16 = 3,
  int32 = 4,
  float32 = 5,
  float64 = 6,
  uint8 = 7,
  uint16 = 8,
  uint32 = 9,
  int64 = 10,
  uint64 = 11
};

/// Bytes of one value; 0 for other.
constexpr std::size_t size_of(NetcdfType type) {
  switch (type) {
    case NetcdfType::other:
      return 0;
    case NetcdfType::int8:
    case NetcdfType::text:
    case NetcdfType::uint8:
      return 1;
    case NetcdfType::int16:
    case NetcdfType::uint16:
      return 2;
    case NetcdfType::int32:
    case NetcdfType::float32:
    case NetcdfType::uint32:
      return 4;
    default:
      return 8;
  }
}

constexpr bool is_real(NetcdfType type) {
  return type == NetcdfType::float32 || type == NetcdfType::float64;
}

constexpr bool is_whole(NetcdfType type) {
  return type != NetcdfType::other && type != NetcdfType::text && !is_real(type);
}

struct NetcdfDimension {
  std::string name;
  std::size_t length = 0;
  bool is_record = false;  ///< it can grow; of a classic file one at most
};

struct NetcdfAttribute {
  std::string name;
  std::string text;             ///< of text
  std::vector<double> numbers;  ///< else
};

/// The attribute of that name among them, or null.
inline const NetcdfAttribute* find_attribute(const std::vector<NetcdfAttribute>& attributes, std::string_view name) {
  const auto found = std::ranges::find(attributes, name, &NetcdfAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

struct NetcdfVariable {
  std::string name;
  NetcdfType type = NetcdfType::other;
  std::vector<std::size_t> dimensions;  ///< places among the file's
  std::vector<std::size_t> shape;       ///< their lengths
  std::vector<NetcdfAttribute> attributes;
  bool has_records = false;       ///< the first dimension is the record dimension of a classic file
  std::uint64_t begin = 0;        ///< byte offset of the first value, where they are not packed
  std::uint64_t record_step = 0;  ///< classic files: bytes from a record to the next
  std::string dataset;            ///< netCDF-4 files: the path of its values
  bool is_big_endian = true;      ///< as all of classic files
  bool is_packed = false;         ///< netCDF-4 files: the values do not stand in the file one after the other

  /// The text of the attribute of that name; empty where there is none, or no text.
  std::string_view text_of(std::string_view attribute) const {
    const NetcdfAttribute* const found = find_attribute(attributes, attribute);
    return found == nullptr ? std::string_view() : found->text;
  }
};

/// What a file declares.
struct NetcdfContent {
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfAttribute> attributes;
  std::vector<NetcdfVariable> variables;
  /// Variables of netCDF-4 files that have not grown as far as their dimensions, which are none of `variables`.
  std::vector<std::string> incomplete;
};

}  // namespace trismooth

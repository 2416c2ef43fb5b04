// SPDX-License-Identifier: BSD-3-Clause
// The classic formats as the "NetCDF classic format specification" has them: numbers of big endian, names and values
// filled up to four bytes, the values of each variable in one piece, those of records record by record.
#include "trismooth/mesh_io/netcdf/netcdf_header.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::uint32_t dimension_tag = 10;
constexpr std::uint32_t variable_tag = 11;
constexpr std::uint32_t attribute_tag = 12;

std::uint64_t filled_up(std::uint64_t bytes) {
  constexpr std::uint64_t step = 4;
  return bytes > std::numeric_limits<std::uint64_t>::max() - step ? bytes : (bytes + step - 1) / step * step;
}

class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes), version_(bytes[3]) {}

  NetcdfContent read() {
    offset_ = 4;
    const std::uint64_t records = count();
    const std::uint64_t streamed = version_ == 5 ? std::numeric_limits<std::uint64_t>::max() : 0xFFFFFFFF;
    for_list(dimension_tag, [this] { read_dimension(); });
    read_attributes(content_.attributes);
    for_list(variable_tag, [this] { read_variable(); });
    set_records(records, records == streamed);
    require_values();
    require_apart();
    return std::move(content_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(path_, message + " (netCDF header, byte " + std::to_string(offset_) + ")");
  }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size() - offset_) {
      fail("is cut off");
    }
    const std::string_view taken = bytes_.substr(offset_, static_cast<std::size_t>(size));
    offset_ += static_cast<std::size_t>(size);
    return taken;
  }

  std::uint64_t number(std::size_t size) {
    const char* const at = take(size).data();
    return size == 4 ? load<std::endian::big, std::uint32_t>(at) : load<std::endian::big, std::uint64_t>(at);
  }

  /// A number of things: of 8 bytes in CDF5.
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }

  std::string_view filled(std::uint64_t size) {
    const std::string_view taken = take(size);
    take(std::min<std::uint64_t>(filled_up(size) - size, bytes_.size() - offset_));
    return taken;
  }

  std::string name() { return std::string(filled(count())); }

  NetcdfType type() {
    const std::uint64_t type = number(4);
    const auto most = static_cast<std::uint64_t>(version_ == 5 ? NetcdfType::uint64 : NetcdfType::float64);
    if (type < 1 || type > most) {
      fail("has values of type " + std::to_string(type) + ", which there is not");
    }
    return static_cast<NetcdfType>(type);
  }

  /// Each item takes bytes, so a number of items that is too large ends at the end of the file.
  template <class ReadItem>
  void for_list(std::uint32_t tag, const ReadItem& read_item) {
    const std::uint64_t found = number(4);
    const std::uint64_t items = count();
    if (found != tag && (found != 0 || items != 0)) {
      fail("has a list of another kind than expected");
    }
    for (std::uint64_t i = 0; i < items; ++i) {
      read_item();
    }
  }

  void read_dimension() {
    NetcdfDimension dimension;
    dimension.name = name();
    dimension.length = static_cast<std::size_t>(count());
    dimension.is_record = dimension.length == 0;
    content_.dimensions.push_back(std::move(dimension));
  }

  void read_attributes(std::vector<NetcdfAttribute>& attributes) {
    for_list(attribute_tag, [&] {
      NetcdfAttribute& attribute = attributes.emplace_back();
      attribute.name = name();
      const NetcdfType type = this->type();
      const std::uint64_t values = count();
      const std::string_view bytes = filled(saturating_product(values, size_of(type)));
      if (type == NetcdfType::text) {
        attribute.text = bytes.substr(0, bytes.find_last_not_of('\0') + 1);
      } else {
        for (std::size_t at = 0; at < bytes.size(); at += size_of(type)) {
          attribute.numbers.push_back(value(type, bytes.data() + at));
        }
      }
    });
  }

  static double value(NetcdfType type, const char* at) {
    constexpr std::endian big = std::endian::big;
    switch (type) {
      case NetcdfType::int8:
        return load<big, std::int8_t>(at);
      case NetcdfType::int16:
        return load<big, std::int16_t>(at);
      case NetcdfType::int32:
        return load<big, std::int32_t>(at);
      case NetcdfType::float32:
        return load<big, float>(at);
      case NetcdfType::float64:
        return load<big, double>(at);
      case NetcdfType::uint16:
        return load<big, std::uint16_t>(at);
      case NetcdfType::uint32:
        return load<big, std::uint32_t>(at);
      case NetcdfType::int64:
        return static_cast<double>(load<big, std::int64_t>(at));
      case NetcdfType::uint64:
        return static_cast<double>(load<big, std::uint64_t>(at));
      default:
        return load<big, std::uint8_t>(at);
    }
  }

  void read_variable() {
    NetcdfVariable variable;
    variable.name = name();
    const std::uint64_t dimensions = count();
    for (std::uint64_t i = 0; i < dimensions; ++i) {
      const std::uint64_t dimension = count();
      if (dimension >= content_.dimensions.size()) {
        fail("the variable " + trismooth::quoted(variable.name) + " names dimension " + std::to_string(dimension) +
             ", of " + std::to_string(content_.dimensions.size()));
      }
      const bool is_record = content_.dimensions[static_cast<std::size_t>(dimension)].is_record;
      if (is_record && i > 0) {
        fail("the variable " + trismooth::quoted(variable.name) + " has records that are not its first dimension");
      }
      variable.has_records = variable.has_records || is_record;
      variable.dimensions.push_back(static_cast<std::size_t>(dimension));
      variable.shape.push_back(content_.dimensions[static_cast<std::size_t>(dimension)].length);
    }
    read_attributes(variable.attributes);
    variable.type = type();
    count();  // its bytes, which follow from the shape, and are wrong where they need more than 32 bits
    variable.begin = number(version_ == 1 ? 4 : 8);
    content_.variables.push_back(std::move(variable));
  }

  /// Of a variable without records, or of one record.
  static std::uint64_t bytes_of(const NetcdfVariable& variable) {
    std::uint64_t bytes = size_of(variable.type);
    for (std::size_t i = variable.has_records ? 1 : 0; i < variable.shape.size(); ++i) {
      bytes = saturating_product(bytes, variable.shape[i]);
    }
    return bytes;
  }

  void set_records(std::uint64_t records, bool is_streamed) {
    std::uint64_t step = 0;
    std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
    std::size_t variables = 0;
    for (const NetcdfVariable& variable : content_.variables) {
      if (variable.has_records) {
        const std::uint64_t bytes = filled_up(bytes_of(variable));
        step = bytes > std::numeric_limits<std::uint64_t>::max() - step ? bytes : step + bytes;
        begin = std::min(begin, variable.begin);
        ++variables;
      }
    }
    for (const NetcdfVariable& variable : content_.variables) {
      // One alone is not filled up.
      step = variable.has_records && variables == 1 ? bytes_of(variable) : step;
    }
    if (is_streamed) {
      // Whoever wrote it could not go back to say how many there are.
      records = step == 0 || begin > bytes_.size() ? 0 : (bytes_.size() - begin) / step;
    }
    for (NetcdfDimension& dimension : content_.dimensions) {
      dimension.length = dimension.is_record ? static_cast<std::size_t>(records) : dimension.length;
    }
    for (NetcdfVariable& variable : content_.variables) {
      if (variable.has_records) {
        variable.record_step = step;
        variable.shape.front() = static_cast<std::size_t>(records);
      }
    }
  }

  void require_values() const {
    std::uint64_t left = bytes_.size();
    for (const NetcdfVariable& variable : content_.variables) {
      const std::uint64_t bytes = bytes_of(variable);
      const std::uint64_t records = variable.has_records ? variable.shape.front() : 1;
      const std::uint64_t all = saturating_product(bytes, records);
      const std::uint64_t steps = saturating_product(variable.record_step, records == 0 ? 0 : records - 1);
      const bool is_within = all == 0 || (variable.begin <= bytes_.size() && steps <= bytes_.size() - variable.begin &&
                                          bytes <= bytes_.size() - variable.begin - steps);
      if (!is_within || all > left) {
        throw ReadError(path_, "is cut off or damaged: the values of " + trismooth::quoted(variable.name) +
                                   " are not all in the file, which has " + std::to_string(bytes_.size()) + " bytes");
      }
      left -= all;
    }
  }

  /// Whoever overwrites the values of one variable is to change no other one, and not the header.
  void require_apart() const {
    using Piece = std::pair<std::uint64_t, std::uint64_t>;  // from here to before there
    std::vector<Piece> pieces{{0, offset_}};
    std::vector<Piece> of_record;
    std::uint64_t records = 0;
    std::uint64_t step = 0;
    for (const NetcdfVariable& variable : content_.variables) {
      const std::uint64_t bytes = bytes_of(variable);
      if (bytes == 0 || (variable.has_records && variable.shape.front() == 0)) {
        continue;
      }
      (variable.has_records ? of_record : pieces).emplace_back(variable.begin, variable.begin + bytes);
      if (variable.has_records) {
        records = variable.shape.front();
        step = variable.record_step;
      }
    }
    bool are_apart = sort_apart(of_record);
    if (!of_record.empty()) {
      const auto [begin, end] = std::pair(of_record.front().first, of_record.back().second);
      are_apart = are_apart && end - begin <= step;
      pieces.emplace_back(begin, end + (records - 1) * step);
    }
    if (!are_apart || !sort_apart(pieces)) {
      throw ReadError(path_, "is damaged: variables, or one and the header, have the same bytes of the file");
    }
  }

  /// Sorts them; whether none reaches into the next.
  static bool sort_apart(std::vector<std::pair<std::uint64_t, std::uint64_t>>& pieces) {
    std::ranges::sort(pieces);
    return std::ranges::adjacent_find(pieces, [](const auto& a, const auto& b) { return b.first < a.second; }) ==
           pieces.end();
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  char version_;
  std::size_t offset_ = 0;
  NetcdfContent content_;
};

}  // namespace

bool is_classic_netcdf(std::string_view bytes) {
  return bytes.size() > 3 && bytes.starts_with("CDF") && (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

NetcdfContent read_netcdf_header(const std::filesystem::path& path, std::string_view bytes) {
  return HeaderReader(path, bytes).read();
}

}  // namespace trismooth

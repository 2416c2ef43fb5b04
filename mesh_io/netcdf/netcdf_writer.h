// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/netcdf/netcdf_content.h"

namespace trismooth {

/// A classic netCDF file to be written: of 64-bit offsets, or CDF5 where a variable has 2 GiB or more.
class NetcdfWriter {
 public:
  /// Returns its place.
  std::size_t add_dimension(std::string name, std::size_t length);
  /// The one that grows; it has one record, or none. Variables that have it, as their first, are added behind all
  /// others.
  std::size_t add_record_dimension(std::string name, bool is_empty);

  void add_attribute(std::string name, std::string text);
  void add_attribute(std::string name, NetcdfType type, double number);

  /// A variable whose value number i is value(i), an int, a float or a double, asked for when write() comes to it, by
  /// any worker; what it refers to must be there then.
  template <class Value>
  void add_variable(std::string name, std::vector<std::size_t> dimensions, Value value,
                    std::vector<NetcdfAttribute> attributes = {}) {
    using Number = std::invoke_result_t<Value, std::size_t>;
    static_assert(std::is_same_v<Number, std::int32_t> || std::is_same_v<Number, float> ||
                  std::is_same_v<Number, double>);
    const NetcdfType type = std::is_same_v<Number, std::int32_t> ? NetcdfType::int32
                            : std::is_same_v<Number, float>      ? NetcdfType::float32
                                                                 : NetcdfType::float64;
    add(std::move(name), type, std::move(dimensions), std::move(attributes),
        [value = std::move(value)](std::size_t begin, std::size_t end, std::byte* target) {
          for (std::size_t i = begin; i < end; ++i) {
            const Number number = in_byte_order<std::endian::big>(value(i));
            std::memcpy(target + sizeof(Number) * (i - begin), &number, sizeof(Number));
          }
        });
  }

  /// A variable of texts, the second of whose dimensions is their length: longer ones are cut off.
  void add_texts(std::string name, std::vector<std::size_t> dimensions, std::vector<std::string> texts);

  /// Writes the file to the plain path. Throws WriteError.
  void write(const std::filesystem::path& path, const FileWorkers& workers) const;

 private:
  /// Fills in the bytes of values from `begin` to before `end`.
  using Fill = std::function<void(std::size_t begin, std::size_t end, std::byte* target)>;

  void add(std::string name, NetcdfType type, std::vector<std::size_t> dimensions,
           std::vector<NetcdfAttribute> attributes, Fill fill);
  /// Of a variable; of one with records, in one of these.
  std::size_t values_of(const NetcdfVariable& variable) const;
  std::string header(char version, std::size_t begin_of_values) const;

  NetcdfContent content_;
  std::vector<NetcdfType> attribute_types_;  ///< of the file's attributes
  std::vector<Fill> fills_;                  ///< of the variables
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

/// Classic netCDF files, byte by byte as the specification of the format has them; the numbers of types are its own.
/// And netCDF-4 files, by HDF5's own calls.
class NetcdfBuilder {
 public:
  enum Type : int { int8 = 1, text = 2, int16 = 3, int32 = 4, float32 = 5, float64 = 6, int64 = 10 };

  struct Attribute {
    std::string name;
    std::string text;
    std::vector<double> numbers = {};  ///< instead of the text
    Type type = int32;                 ///< of these
  };

  /// Version 1, 2 (64-bit offsets), 4 or 5.
  explicit NetcdfBuilder(int version) : version_(version) {}

  /// Returns its number; of length 0 it grows, and has `records` records.
  int dimension(const std::string& name, std::size_t length, std::size_t records = 0);
  void attribute(Attribute attribute) { attributes_.push_back(std::move(attribute)); }
  void variable(const std::string& name, Type type, std::vector<int> dimensions, std::vector<double> values,
                std::vector<Attribute> attributes = {});
  /// Texts of that many characters each.
  void texts(const std::string& name, std::vector<int> dimensions, const std::vector<std::string>& texts);

  /// How variables of version 4 say which dimensions they have: as the library has done it from the beginning, or as it
  /// does it as well in files of today.
  enum class Naming { by_reference, by_number, not_at_all };
  void name_dimensions(Naming naming) { naming_ = naming; }

  /// Of version 4 in builds with HDF5 alone.
  std::string bytes() const;

 private:
  struct Variable {
    std::string name;
    Type type;
    std::vector<int> dimensions;
    std::vector<Attribute> attributes;
    std::string bytes;  ///< of all values, or records one behind the other, in big endian
    bool has_records;
  };

  std::string count(std::size_t value) const;
  std::string name(const std::string& name) const;
  std::string list(int tag, std::size_t items) const;
  std::string attributes(const std::vector<Attribute>& all) const;
  std::string netcdf4_bytes() const;

  int version_;
  Naming naming_ = Naming::by_reference;
  std::size_t records_ = 0;
  std::vector<std::pair<std::string, std::size_t>> dimensions_;
  std::vector<Attribute> attributes_;
  std::vector<Variable> variables_;
};

}  // namespace test_support

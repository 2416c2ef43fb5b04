// SPDX-License-Identifier: BSD-3-Clause
#include "support/netcdf_builder.h"

#include <bit>
#include <cstdint>
#include <stdexcept>

#ifdef TRISMOOTH_HAS_HDF5
#include <algorithm>

#include "support/small_hdf5.h"
#endif

namespace test_support {

namespace {

std::string big_endian(std::uint64_t value, int size) {
  std::string bytes;
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
  return bytes;
}

std::string filled(std::string bytes) {
  while (bytes.size() % 4 != 0) {
    bytes += '\0';
  }
  return bytes;
}

std::string number(NetcdfBuilder::Type type, double value) {
  switch (type) {
    case NetcdfBuilder::float32:
      return big_endian(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    case NetcdfBuilder::float64:
      return big_endian(std::bit_cast<std::uint64_t>(value), 8);
    default:
      break;
  }
  const int size = type == NetcdfBuilder::int64   ? 8
                   : type == NetcdfBuilder::int32 ? 4
                   : type == NetcdfBuilder::int16 ? 2
                                                  : 1;
  return big_endian(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), size);
}

}  // namespace

int NetcdfBuilder::dimension(const std::string& name, std::size_t length, std::size_t records) {
  dimensions_.emplace_back(name, length);
  records_ = length == 0 ? records : records_;
  return static_cast<int>(dimensions_.size()) - 1;
}

void NetcdfBuilder::variable(const std::string& name, Type type, std::vector<int> dimensions,
                             std::vector<double> values, std::vector<Attribute> attributes) {
  std::string bytes;
  for (const double value : values) {
    bytes += number(type, value);
  }
  const bool has_records = !dimensions.empty() && dimensions_.at(static_cast<std::size_t>(dimensions[0])).second == 0;
  variables_.push_back({name, type, std::move(dimensions), std::move(attributes), std::move(bytes), has_records});
}

void NetcdfBuilder::texts(const std::string& name, std::vector<int> dimensions, const std::vector<std::string>& texts) {
  variable(name, text, dimensions, {});
  for (std::string characters : texts) {
    characters.resize(dimensions_.at(static_cast<std::size_t>(dimensions.back())).second);
    variables_.back().bytes += characters;
  }
}

std::string NetcdfBuilder::count(std::size_t value) const {
  return big_endian(value, version_ == 5 ? 8 : 4);
}

std::string NetcdfBuilder::name(const std::string& name) const {
  return count(name.size()) + filled(name);
}

std::string NetcdfBuilder::list(int tag, std::size_t items) const {
  return big_endian(items == 0 ? 0 : static_cast<std::uint64_t>(tag), 4) + count(items);
}

std::string NetcdfBuilder::attributes(const std::vector<Attribute>& all) const {
  std::string bytes = list(12, all.size());
  for (const Attribute& attribute : all) {
    bytes += name(attribute.name);
    if (attribute.numbers.empty()) {
      bytes += big_endian(text, 4) + name(attribute.text);
      continue;
    }
    bytes += big_endian(attribute.type, 4) + count(attribute.numbers.size());
    std::string numbers;
    for (const double value : attribute.numbers) {
      numbers += number(attribute.type, value);
    }
    bytes += filled(numbers);
  }
  return bytes;
}

#ifdef TRISMOOTH_HAS_HDF5

std::string NetcdfBuilder::netcdf4_bytes() const {
  SmallHdf5 file;
  constexpr std::string_view none = "This is a netCDF dimension but not a netCDF variable.";
  const auto is_variable = [this](const std::string& name) {
    return std::ranges::any_of(variables_, [&name](const Variable& variable) { return variable.name == name; });
  };
  for (std::size_t i = 0; i < dimensions_.size(); ++i) {
    const auto& [name, length] = dimensions_[i];
    if (naming_ == Naming::not_at_all || is_variable(name)) {
      continue;
    }
    file.dataset("/" + name, H5T_IEEE_F32BE, {length}, length == 0, "");
    file.text("/" + name, "CLASS", "DIMENSION_SCALE", 16);
    file.text("/" + name, "NAME", std::string(none), none.size() + 1);
    if (naming_ == Naming::by_number) {
      file.attribute("/" + name, "_Netcdf4Dimid", static_cast<std::int32_t>(i));
    }
  }
  const auto add_attributes = [&file](const std::string& object, const std::vector<Attribute>& all) {
    for (const Attribute& attribute : all) {
      if (attribute.numbers.empty()) {
        file.text(object, attribute.name, attribute.text, std::max<std::size_t>(attribute.text.size(), 1));
      } else {
        file.attributes(object, attribute.name, attribute.numbers);
      }
    }
  };
  add_attributes("/", attributes_);
  for (const Variable& variable : variables_) {
    std::vector<hsize_t> extents;
    std::vector<std::int32_t> numbers;
    std::vector<std::string> scales;
    for (const int dimension : variable.dimensions) {
      const auto& [name, length] = dimensions_.at(static_cast<std::size_t>(dimension));
      extents.push_back(length == 0 ? records_ : length);
      numbers.push_back(dimension);
      scales.push_back("/" + name);
    }
    const hid_t type = variable.type == int32     ? H5T_STD_I32BE
                       : variable.type == int64   ? H5T_STD_I64BE
                       : variable.type == float32 ? H5T_IEEE_F32BE
                       : variable.type == float64 ? H5T_IEEE_F64BE
                                                  : H5T_C_S1;
    const std::string path = "/" + variable.name;
    file.dataset(path, type, extents, variable.has_records, variable.bytes);
    if (naming_ == Naming::by_number && !numbers.empty()) {
      file.attributes(path, "_Netcdf4Coordinates", numbers);
    } else if (naming_ == Naming::by_reference && !scales.empty()) {
      file.references(path, "DIMENSION_LIST", scales);
    }
    add_attributes(path, variable.attributes);
  }
  return file.bytes();
}

#else

std::string NetcdfBuilder::netcdf4_bytes() const {
  throw std::logic_error("no netCDF-4 files without HDF5");
}

#endif

std::string NetcdfBuilder::bytes() const {
  if (version_ == 4) {
    return netcdf4_bytes();
  }
  // Once to know how long the header is, and once with the places of values.
  std::string header;
  for (int pass = 0; pass < 2; ++pass) {
    std::size_t begin = header.size();
    header = std::string("CDF") + static_cast<char>(version_) + count(records_) + list(10, dimensions_.size());
    for (const auto& [dimension, length] : dimensions_) {
      header += name(dimension) + count(length);
    }
    header += attributes(attributes_) + list(11, variables_.size());
    std::vector<std::string> heads(variables_.size());
    for (const bool records : {false, true}) {
      for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Variable& variable = variables_[i];
        if (variable.has_records != records) {
          continue;
        }
        heads[i] = name(variable.name) + count(variable.dimensions.size());
        for (const int dimension : variable.dimensions) {
          heads[i] += count(static_cast<std::size_t>(dimension));
        }
        const std::size_t size = records && records_ > 0 ? variable.bytes.size() / records_ : variable.bytes.size();
        heads[i] += attributes(variable.attributes) + big_endian(variable.type, 4) + count((size + 3) / 4 * 4) +
                    big_endian(begin, version_ == 1 ? 4 : 8);
        begin += (size + 3) / 4 * 4;
      }
    }
    for (const std::string& head : heads) {
      header += head;
    }
  }
  std::string all = header;
  for (const Variable& variable : variables_) {
    all += variable.has_records ? "" : filled(variable.bytes);
  }
  for (std::size_t record = 0; record < records_; ++record) {
    for (const Variable& variable : variables_) {
      const std::size_t size = variable.bytes.size() / records_;
      all += variable.has_records ? filled(variable.bytes.substr(record * size, size)) : "";
    }
  }
  return all;
}

}  // namespace test_support

// SPDX-License-Identifier: BSD-3-Clause
// As "The NetCDF-4 Format" of the netCDF user's guide says: a dimension is a dataset that is a dimension scale of HDF5,
// with values where there is a variable of its name. Other datasets name their scales by references (DIMENSION_LIST),
// or by numbers (_Netcdf4Coordinates) that scales have in their order, or as they say (_Netcdf4Dimid).
#include "trismooth/mesh_io/netcdf/netcdf4_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// What deflate makes of one byte at most, and what small files may have besides.
constexpr std::uint64_t most_expansion = 1040;
constexpr std::uint64_t always_allowed = std::uint64_t{1} << 20;

/// Attributes that netCDF keeps for itself.
bool is_hidden(std::string_view attribute) {
  constexpr std::array names{"CLASS",           "NAME",        "DIMENSION_LIST",      "REFERENCE_LIST",
                             "_Netcdf4Dimid",   "_nc3_strict", "_Netcdf4Coordinates", "_NCProperties",
                             "DIMENSION_LABELS"};
  return std::ranges::find(names, attribute) != names.end();
}

NetcdfType type_of(const Hdf5Shape& shape) {
  if (shape.is_text) {
    return NetcdfType::text;
  }
  if (!shape.type) {
    return NetcdfType::other;
  }
  switch (*shape.type) {
    case ScalarType::int8:
      return NetcdfType::int8;
    case ScalarType::uint8:
      return NetcdfType::uint8;
    case ScalarType::int16:
      return NetcdfType::int16;
    case ScalarType::uint16:
      return NetcdfType::uint16;
    case ScalarType::int32:
      return NetcdfType::int32;
    case ScalarType::uint32:
      return NetcdfType::uint32;
    case ScalarType::int64:
      return NetcdfType::int64;
    case ScalarType::uint64:
      return NetcdfType::uint64;
    case ScalarType::float32:
      return NetcdfType::float32;
    case ScalarType::float64:
      break;
  }
  return NetcdfType::float64;
}

/// Reads what the root group declares.
class ContentReader {
 public:
  ContentReader(const Hdf5Reader& file, std::size_t bytes)
      : file_(file), left_(saturating_product(bytes, most_expansion) / 2 + always_allowed) {}

  NetcdfContent read() {
    for (const Hdf5Member& member : file_.members("/")) {
      if (member.kind == Hdf5Kind::dataset) {
        find_dataset(member.name);
      }
    }
    read_attributes("/", file_.attribute_names("/"), content_.attributes);
    for (const Dataset& dataset : datasets_) {
      if (dataset.is_variable) {
        read_variable(dataset);
      }
    }
    set_incomplete_aside();
    return std::move(content_);
  }

 private:
  struct Dataset {
    std::string path;
    std::string name;
    Hdf5Shape shape;
    std::vector<std::string> attributes;
    std::optional<std::size_t> scale;  ///< the dimension that it is
    bool is_variable = true;
  };

  bool has(const Dataset& dataset, std::string_view attribute) const {
    return std::ranges::find(dataset.attributes, attribute) != dataset.attributes.end();
  }

  /// The text of an attribute that netCDF keeps for itself; empty where there is none.
  std::string hidden_text(const Dataset& dataset, const std::string& attribute) const {
    if (!has(dataset, attribute) || !file_.attribute_shape(dataset.path, attribute).is_text) {
      return {};
    }
    const std::vector<std::string> texts = file_.read_attribute_texts(dataset.path, attribute);
    return texts.empty() ? std::string() : texts.front();
  }

  /// The whole numbers of such an attribute, or none.
  std::vector<std::int64_t> hidden_numbers(const Dataset& dataset, const std::string& attribute) const {
    const NetcdfType type =
        has(dataset, attribute) ? type_of(file_.attribute_shape(dataset.path, attribute)) : NetcdfType::other;
    return is_whole(type) ? file_.read_attribute<std::int64_t>(dataset.path, attribute) : std::vector<std::int64_t>();
  }

  void find_dataset(const std::string& name) {
    // A variable that has the name of a dimension and is not its coordinate.
    constexpr std::string_view aside = "_nc4_non_coord_";
    Dataset& dataset = datasets_.emplace_back();
    dataset.path = "/" + name;
    dataset.name = name.starts_with(aside) ? name.substr(aside.size()) : name;
    dataset.shape = file_.shape_of(dataset.path);
    dataset.attributes = file_.attribute_names(dataset.path);
    if (hidden_text(dataset, "CLASS") != "DIMENSION_SCALE") {
      return;
    }
    dataset.is_variable =
        !hidden_text(dataset, "NAME").starts_with("This is a netCDF dimension but not a netCDF variable");
    dataset.scale = content_.dimensions.size();
    const std::vector<std::int64_t> own = hidden_numbers(dataset, "_Netcdf4Dimid");
    by_number_.emplace(own.size() == 1 ? own.front() : next_number_++, *dataset.scale);
    by_reference_.emplace(file_.reference_to(dataset.path), *dataset.scale);
    content_.dimensions.push_back(
        {name, dataset.shape.extents.empty() ? 1 : static_cast<std::size_t>(dataset.shape.extents.front()), false});
  }

  void read_variable(const Dataset& dataset) {
    NetcdfVariable& variable = content_.variables.emplace_back();
    variable.name = dataset.name;
    variable.dataset = dataset.path;
    variable.type = type_of(dataset.shape);
    const std::optional<Hdf5Place> place = file_.place_of(dataset.path);
    variable.is_packed = !place;
    variable.begin = place ? place->begin : 0;
    variable.is_big_endian = place && place->is_big_endian;
    const std::uint64_t bytes = saturating_product(dataset.shape.count(), size_of(variable.type));
    if (bytes > left_) {
      throw ReadError(file_.file(), "is damaged: the values of " + trismooth::quoted(variable.name) +
                                        " are more than a file of this size can hold");
    }
    left_ -= bytes;
    variable.shape.assign(dataset.shape.extents.begin(), dataset.shape.extents.end());
    variable.dimensions = dimensions_of(dataset);
    for (std::size_t i = 0; i < variable.shape.size(); ++i) {
      // Nobody but its variables says how far a dimension has grown that has no values of its own.
      std::size_t& length = content_.dimensions[variable.dimensions[i]].length;
      length = std::max(length, variable.shape[i]);
    }
    read_attributes(dataset.path, dataset.attributes, variable.attributes);
  }

  void set_incomplete_aside() {
    std::erase_if(content_.variables, [this](const NetcdfVariable& variable) {
      bool is_incomplete = false;
      for (std::size_t i = 0; i < variable.shape.size(); ++i) {
        is_incomplete = is_incomplete || variable.shape[i] != content_.dimensions[variable.dimensions[i]].length;
      }
      if (is_incomplete) {
        content_.incomplete.push_back(variable.name);
      }
      return is_incomplete;
    });
  }

  std::vector<std::size_t> dimensions_of(const Dataset& dataset) {
    const std::size_t rank = dataset.shape.extents.size();
    std::vector<std::size_t> dimensions;
    if (rank == 1 && dataset.scale) {
      return {*dataset.scale};
    }
    const auto add = [&dimensions](const auto& places, const auto& numbers) {
      dimensions.clear();
      for (const auto number : numbers) {
        if (const auto place = places.find(number); place != places.end()) {
          dimensions.push_back(place->second);
        }
      }
    };
    add(by_number_, hidden_numbers(dataset, "_Netcdf4Coordinates"));
    if (dimensions.size() != rank && has(dataset, "DIMENSION_LIST")) {
      add(by_reference_, file_.read_attribute_references(dataset.path, "DIMENSION_LIST"));
    }
    if (dimensions.size() != rank) {
      dimensions.clear();
      for (const std::uint64_t length : dataset.shape.extents) {
        dimensions.push_back(nameless(static_cast<std::size_t>(length), dimensions));
      }
    }
    return dimensions;
  }

  /// A dimension of datasets without scales, which is not one of these: as netCDF has it, one for each length.
  std::size_t nameless(std::size_t length, const std::vector<std::size_t>& but) {
    for (const std::size_t place : nameless_[length]) {
      if (std::ranges::find(but, place) == but.end()) {
        return place;
      }
    }
    const std::size_t place = content_.dimensions.size();
    content_.dimensions.push_back({"phony_dim_" + std::to_string(nameless_count_++), length, false});
    nameless_[length].push_back(place);
    return place;
  }

  void read_attributes(const std::string& object, const std::vector<std::string>& names,
                       std::vector<NetcdfAttribute>& attributes) {
    for (const std::string& name : names) {
      if (is_hidden(name)) {
        continue;
      }
      NetcdfAttribute& attribute = attributes.emplace_back();
      attribute.name = name;
      const Hdf5Shape shape = file_.attribute_shape(object, name);
      if (shape.is_text && shape.count() == 1) {
        attribute.text = file_.read_attribute_texts(object, name).front();
      } else if (shape.type) {
        attribute.numbers = file_.read_attribute<double>(object, name);
      }
      const std::uint64_t bytes = attribute.text.size() + sizeof(double) * attribute.numbers.size();
      if (bytes > left_) {
        throw ReadError(file_.file(), "is damaged: its attributes are more than a file of this size can hold");
      }
      left_ -= bytes;
    }
  }

  const Hdf5Reader& file_;
  std::uint64_t left_;
  NetcdfContent content_;
  std::vector<Dataset> datasets_;
  std::map<std::int64_t, std::size_t> by_number_;  ///< dimensions, as variables name them
  std::map<std::uint64_t, std::size_t> by_reference_;
  std::int64_t next_number_ = 0;
  std::map<std::size_t, std::vector<std::size_t>> nameless_;  ///< by their lengths
  std::size_t nameless_count_ = 0;
};

class Hdf5NetcdfFile : public Netcdf4File {
 public:
  Hdf5NetcdfFile(const std::filesystem::path& path, std::string_view bytes)
      : file_(path, bytes), bytes_(bytes.size()) {}

  NetcdfContent content() const override { return ContentReader(file_, bytes_).read(); }

  void read(const NetcdfVariable& variable, std::span<const std::size_t> begin, std::span<const std::size_t> counts,
            ScalarType type, void* values) const override {
    file_.read_part(variable.dataset, begin, counts, type, values);
  }

  std::string characters(const NetcdfVariable& variable) const override {
    return file_.read_characters(variable.dataset);
  }

 private:
  Hdf5Reader file_;
  std::size_t bytes_;
};

}  // namespace

std::unique_ptr<const Netcdf4File> open_netcdf4(const std::filesystem::path& path, std::string_view bytes) {
  return std::make_unique<const Hdf5NetcdfFile>(path, bytes);
}

}  // namespace trismooth

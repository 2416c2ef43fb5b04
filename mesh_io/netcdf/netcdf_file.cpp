// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/netcdf/netcdf_file.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/netcdf/netcdf_header.h"
#include "trismooth/mesh_io/scalar_type_of.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Calls function with a number of the C++ type.
template <class Function>
void visit_netcdf_type(NetcdfType type, const Function& function) {
  switch (type) {
    case NetcdfType::other:
      return;
    case NetcdfType::int8:
      return function(std::int8_t{});
    case NetcdfType::text:
      return function(char{});
    case NetcdfType::int16:
      return function(std::int16_t{});
    case NetcdfType::int32:
      return function(std::int32_t{});
    case NetcdfType::float32:
      return function(float{});
    case NetcdfType::float64:
      return function(double{});
    case NetcdfType::uint8:
      return function(std::uint8_t{});
    case NetcdfType::uint16:
      return function(std::uint16_t{});
    case NetcdfType::uint32:
      return function(std::uint32_t{});
    case NetcdfType::int64:
      return function(std::int64_t{});
    case NetcdfType::uint64:
      return function(std::uint64_t{});
  }
}

}  // namespace

NetcdfFile::NetcdfFile(std::filesystem::path path, std::string_view bytes, const FileWorkers& workers)
    : path_(std::move(path)), bytes_(bytes), workers_(workers) {
  if (is_classic_netcdf(bytes)) {
    content_ = read_netcdf_header(path_, bytes);
  } else if (is_hdf5(bytes)) {
    netcdf4_ = open_netcdf4(path_, bytes);
    content_ = netcdf4_->content();
  } else {
    throw ReadError(path_, "is no netCDF file: these begin with 'CDF' or, netCDF-4, as HDF5 files do");
  }
  for (const NetcdfVariable& variable : content_.variables) {
    variables_.emplace(variable.name, &variable);
  }
}

void NetcdfFile::fail(const NetcdfVariable& variable, const std::string& message) const {
  throw ReadError(path_, "the variable " + trismooth::quoted(variable.name) + " " + message);
}

std::optional<std::size_t> NetcdfFile::length_of(std::string_view dimension) const {
  const auto found = std::ranges::find(content_.dimensions, dimension, &NetcdfDimension::name);
  return found == content_.dimensions.end() ? std::nullopt : std::optional(found->length);
}

const NetcdfVariable* NetcdfFile::find(std::string_view variable) const {
  const auto found = variables_.find(variable);
  return found == variables_.end() ? nullptr : found->second;
}

NetcdfFile::Part NetcdfFile::part_of(const NetcdfVariable& variable, std::span<const std::size_t> leading) const {
  Part part;
  if (leading.size() > variable.shape.size()) {
    fail(variable, "has fewer dimensions than expected");
  }
  part.begin.resize(variable.shape.size());
  part.counts = variable.shape;
  for (std::size_t i = 0; i < leading.size(); ++i) {
    if (leading[i] >= variable.shape[i]) {
      fail(variable, "has fewer rows than expected");
    }
    part.begin[i] = leading[i];
    part.counts[i] = 1;
  }
  part.size = std::accumulate(part.counts.begin(), part.counts.end(), std::size_t{1}, std::multiplies<>());
  return part;
}

std::uint64_t NetcdfFile::offset_of(const NetcdfVariable& variable, std::span<const std::size_t> leading) {
  std::uint64_t offset = variable.begin;
  std::uint64_t step = size_of(variable.type);
  for (std::size_t i = variable.shape.size(); i-- > 0;) {
    const bool is_record = i == 0 && variable.has_records;
    offset += (is_record ? variable.record_step : step) * (i < leading.size() ? leading[i] : 0);
    step *= variable.shape[i];
  }
  return offset;
}

template <class T>
void NetcdfFile::read_classic(const NetcdfVariable& variable, std::uint64_t offset, std::span<T> values) const {
  visit_netcdf_type(variable.type, [&](auto zero) {
    using Stored = decltype(zero);
    const char* const from = bytes_.data() + offset;
    for_file_blocks(workers_, values.size(), sizeof(Stored), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): it is a number
        values[i] = static_cast<T>(load<std::endian::big, Stored>(from + sizeof(Stored) * i));
      }
    });
  });
}

template <class T>
void NetcdfFile::read(const NetcdfVariable& variable, std::span<const std::size_t> leading, std::span<T> values) const {
  const bool is_held = std::is_same_v<T, char>       ? variable.type == NetcdfType::text
                       : std::is_floating_point_v<T> ? is_whole(variable.type) || is_real(variable.type)
                                                     : is_whole(variable.type);
  if (!is_held) {
    fail(variable, std::is_same_v<T, char>       ? "is not of text"
                   : std::is_floating_point_v<T> ? "is not of numbers"
                                                 : "is not of whole numbers");
  }
  if (!is_classic()) {
    if constexpr (std::is_same_v<T, char>) {
      std::ranges::copy(netcdf4_->characters(variable), values.begin());
    } else {
      const Part part = part_of(variable, leading);
      netcdf4_->read(variable, part.begin, part.counts, scalar_type_of<T>(), values.data());
    }
  } else if (variable.has_records && leading.empty()) {
    const std::size_t records = variable.shape.front();
    const std::size_t each = records == 0 ? 0 : values.size() / records;
    for (std::size_t record = 0; record < records; ++record) {
      read_classic(variable, variable.begin + record * variable.record_step, values.subspan(record * each, each));
    }
  } else if (!values.empty()) {
    read_classic(variable, offset_of(variable, leading), values);
  }
}

template void NetcdfFile::read(const NetcdfVariable&, std::span<const std::size_t>, std::span<std::int32_t>) const;

template <class T>
std::vector<T> NetcdfFile::values(const NetcdfVariable& variable, std::span<const std::size_t> leading) const {
  std::vector<T> values;
  shared_resize(values, part_of(variable, leading).size, workers_.workers);
  read(variable, leading, std::span<T>(values));
  return values;
}

template std::vector<std::int32_t> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
template std::vector<std::int64_t> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
template std::vector<float> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;
template std::vector<double> NetcdfFile::values(const NetcdfVariable&, std::span<const std::size_t>) const;

DataArray NetcdfFile::real_array(std::string name, const NetcdfVariable& variable,
                                 std::span<const std::size_t> leading) const {
  return variable.type == NetcdfType::float32 ? make_data_array(std::move(name), 1, values<float>(variable, leading))
                                              : make_data_array(std::move(name), 1, values<double>(variable, leading));
}

std::vector<std::string> NetcdfFile::texts(const NetcdfVariable& variable) const {
  const std::vector<char> characters = values<char>(variable);
  const std::size_t length = variable.shape.empty() ? 1 : variable.shape.back();
  std::vector<std::string> texts;
  for (std::size_t at = 0; length > 0 && at < characters.size(); at += length) {
    std::string text(characters.data() + at, length);
    text.erase(std::min(text.find('\0'), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

void add_note_of_incomplete(const NetcdfFile& file, MeshDocument& document) {
  const std::vector<std::string>& names = file.content().incomplete;
  if (!names.empty()) {
    constexpr std::size_t most = 8;
    document.notes.push_back("Variables that have fewer values than their dimensions ask for stay in the file alone: " +
                             first_of_list(names, most) + ".");
  }
}

}  // namespace trismooth

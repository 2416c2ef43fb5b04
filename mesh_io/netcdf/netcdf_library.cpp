// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/netcdf/netcdf_library.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

#include <netcdf.h>
#include <netcdf_mem.h>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_mutex.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Throws what the library says is wrong with the file, unless nothing is.
void require_read(const std::filesystem::path& path, int status, std::string_view what) {
  if (status != NC_NOERR) {
    throw ReadError(path, "is a damaged netCDF-4 file: " + std::string(what) + ": " + nc_strerror(status));
  }
}

void require_written(const std::filesystem::path& path, int status) {
  if (status != NC_NOERR) {
    throw WriteError(path, std::string("netCDF-4: ") + nc_strerror(status));
  }
}

NetcdfType type_of(nc_type type) {
  return type >= NC_BYTE && type <= NC_UINT64 ? static_cast<NetcdfType>(type) : NetcdfType::other;
}

using LongName = std::array<char, NC_MAX_NAME + 1>;

/// What deflate makes of one byte at most, and what small files may have besides.
constexpr std::uint64_t most_expansion = 1100;
constexpr std::uint64_t always_allowed = std::uint64_t{1} << 20;

class ContentReader {
 public:
  ContentReader(const std::filesystem::path& path, int id, std::size_t bytes)
      : path_(path), id_(id), left_(saturating_product(bytes, most_expansion) / 2 + always_allowed) {}

  NetcdfContent read() {
    int dimensions = 0;
    int variables = 0;
    int attributes = 0;
    require_read(path_, nc_inq(id_, &dimensions, &variables, &attributes, nullptr), "its content");
    for (int i = 0; i < dimensions; ++i) {
      LongName name{};
      std::size_t length = 0;
      require_read(path_, nc_inq_dim(id_, i, name.data(), &length), "a dimension");
      content_.dimensions.push_back({name.data(), length, false});
    }
    read_attributes(NC_GLOBAL, attributes, content_.attributes);
    for (int i = 0; i < variables; ++i) {
      read_variable(i);
    }
    return std::move(content_);
  }

 private:
  void read_variable(int number) {
    LongName name{};
    nc_type type = NC_NAT;
    int dimensions = 0;
    int attributes = 0;
    require_read(path_, nc_inq_var(id_, number, name.data(), &type, &dimensions, nullptr, &attributes), "a variable");
    std::vector<int> of_variable(static_cast<std::size_t>(dimensions));
    require_read(path_, nc_inq_vardimid(id_, number, of_variable.data()), "a variable");
    NetcdfVariable& variable = content_.variables.emplace_back();
    variable.name = name.data();
    variable.type = type_of(type);
    std::uint64_t bytes = size_of(variable.type);
    for (const int dimension : of_variable) {
      if (dimension < 0 || static_cast<std::size_t>(dimension) >= content_.dimensions.size()) {
        throw ReadError(
            path_, "is a damaged netCDF-4 file: a dimension of " + trismooth::quoted(variable.name) + " is none of it");
      }
      variable.dimensions.push_back(static_cast<std::size_t>(dimension));
      variable.shape.push_back(content_.dimensions[variable.dimensions.back()].length);
      bytes = saturating_product(bytes, variable.shape.back());
    }
    if (bytes > left_) {
      throw ReadError(path_, "is damaged: the values of " + trismooth::quoted(variable.name) +
                                 " are more than a file of this size can hold");
    }
    left_ -= bytes;
    read_attributes(number, attributes, variable.attributes);
  }

  void read_attributes(int variable, int count, std::vector<NetcdfAttribute>& attributes) {
    for (int i = 0; i < count; ++i) {
      LongName name{};
      nc_type type = NC_NAT;
      std::size_t length = 0;
      require_read(path_, nc_inq_attname(id_, variable, i, name.data()), "an attribute");
      require_read(path_, nc_inq_att(id_, variable, name.data(), &type, &length), "an attribute");
      if (saturating_product(length, sizeof(double)) > left_) {
        throw ReadError(path_, "is damaged: its attributes are more than a file of this size can hold");
      }
      left_ -= length * sizeof(double);
      NetcdfAttribute& attribute = attributes.emplace_back();
      attribute.name = name.data();
      if (type == NC_CHAR) {
        attribute.text.resize(length);
        require_read(path_, nc_get_att_text(id_, variable, name.data(), attribute.text.data()), "an attribute");
        attribute.text.erase(attribute.text.find_last_not_of('\0') + 1);
      } else if (type == NC_STRING && length == 1) {
        char* text = nullptr;
        require_read(path_, nc_get_att_string(id_, variable, name.data(), &text), "an attribute");
        attribute.text = text == nullptr ? "" : text;
        nc_free_string(1, &text);
      } else if (type >= NC_BYTE && type <= NC_UINT64) {
        attribute.numbers.resize(length);
        require_read(path_, nc_get_att_double(id_, variable, name.data(), attribute.numbers.data()), "an attribute");
      }
    }
  }

  const std::filesystem::path& path_;
  int id_;
  std::uint64_t left_;
  NetcdfContent content_;
};

int get(int id, int variable, const std::size_t* begin, const std::size_t* counts, std::int32_t* values) {
  return nc_get_vara_int(id, variable, begin, counts, values);
}
int get(int id, int variable, const std::size_t* begin, const std::size_t* counts, std::int64_t* values) {
  return nc_get_vara_longlong(id, variable, begin, counts, reinterpret_cast<long long*>(values));
}
int get(int id, int variable, const std::size_t* begin, const std::size_t* counts, float* values) {
  return nc_get_vara_float(id, variable, begin, counts, values);
}
int get(int id, int variable, const std::size_t* begin, const std::size_t* counts, double* values) {
  return nc_get_vara_double(id, variable, begin, counts, values);
}
int get(int id, int variable, const std::size_t* begin, const std::size_t* counts, char* values) {
  return nc_get_vara_text(id, variable, begin, counts, values);
}

}  // namespace

NetcdfLibraryFile::NetcdfLibraryFile(std::filesystem::path path, std::string_view bytes)
    : path_(std::move(path)), bytes_(bytes.size()) {
  const std::lock_guard lock(hdf5_mutex());
  // The library reads them only.
  void* const memory = const_cast<char*>(bytes.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  require_read(path_, nc_open_mem("mesh", NC_NOWRITE, bytes.size(), memory, &id_), "it cannot be opened");
}

NetcdfLibraryFile::~NetcdfLibraryFile() {
  const std::lock_guard lock(hdf5_mutex());
  nc_close(id_);
}

NetcdfContent NetcdfLibraryFile::content() const {
  const std::lock_guard lock(hdf5_mutex());
  return ContentReader(path_, id_, bytes_).read();
}

template <class T>
void NetcdfLibraryFile::read(std::size_t variable, std::span<const std::size_t> begin,
                             std::span<const std::size_t> counts, std::span<T> values) const {
  if (values.empty()) {
    return;
  }
  const std::lock_guard lock(hdf5_mutex());
  require_read(path_, get(id_, static_cast<int>(variable), begin.data(), counts.data(), values.data()),
               "the values of a variable");
}

template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                      std::span<std::int32_t>) const;
template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                      std::span<std::int64_t>) const;
template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                      std::span<float>) const;
template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                      std::span<double>) const;
template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                      std::span<char>) const;

void overwrite_netcdf(const std::filesystem::path& path, std::span<const NetcdfOverwrite> parts) {
  const std::lock_guard lock(hdf5_mutex());
  int id = -1;
  require_written(path, nc_open(path.c_str(), NC_WRITE, &id));
  int status = NC_NOERR;
  for (const NetcdfOverwrite& part : parts) {
    status = status != NC_NOERR ? status
                                : nc_put_vara_double(id, static_cast<int>(part.variable), part.begin.data(),
                                                     part.counts.data(), part.values.data());
  }
  const int closed = nc_close(id);
  require_written(path, status);
  require_written(path, closed);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/netcdf/netcdf_content.h"

namespace trismooth {

/// A netCDF-4 file: an HDF5 file, in which some datasets are dimensions, and attributes say which ones another dataset
/// has. Only a build with HDF5 has any.
class Netcdf4File {
 public:
  Netcdf4File() = default;
  Netcdf4File(const Netcdf4File&) = delete;
  Netcdf4File& operator=(const Netcdf4File&) = delete;
  virtual ~Netcdf4File() = default;

  /// What its root group declares. Throws ReadError, also where its variables hold more than compression makes of files
  /// of this size.
  virtual NetcdfContent content() const = 0;

  /// The numbers of a part of a variable of content() as numbers of `type`, which `values` has room for: `begin` and
  /// `counts` have a number for each dimension. Throws ReadError.
  virtual void read(const NetcdfVariable& variable, std::span<const std::size_t> begin,
                    std::span<const std::size_t> counts, ScalarType type, void* values) const = 0;

  /// All characters of a variable of text. Throws ReadError, also where its values are longer texts.
  virtual std::string characters(const NetcdfVariable& variable) const = 0;
};

/// Opens bytes that are in memory, and stay there. Throws ReadError; in a build without HDF5 always, with a sentence on
/// what makes a classic file.
std::unique_ptr<const Netcdf4File> open_netcdf4(const std::filesystem::path& path, std::string_view bytes);

}  // namespace trismooth

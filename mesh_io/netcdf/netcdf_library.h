// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/netcdf/netcdf_content.h"

namespace trismooth {

/// A netCDF-4 file, which is an HDF5 file, by the netCDF library: the one place that needs it. Without TRISMOOTH_NETCDF
/// the constructor throws ReadError, which names what makes a classic file. All calls wait for hdf5_mutex().
class NetcdfLibraryFile {
 public:
  /// Opens bytes that are in memory, and stay there. Throws ReadError.
  NetcdfLibraryFile(std::filesystem::path path, std::string_view bytes);
  NetcdfLibraryFile(const NetcdfLibraryFile&) = delete;
  NetcdfLibraryFile& operator=(const NetcdfLibraryFile&) = delete;
  ~NetcdfLibraryFile();

  /// What its root group declares. Throws ReadError, also where its variables hold more than compression makes of files
  /// of this size.
  NetcdfContent content() const;

  /// The values of a part of a variable, the one at that place among content().variables, as many as `values` has:
  /// `begin` and `counts` have a number for each dimension. T is int32, int64, float, double or char. Throws ReadError.
  template <class T>
  void read(std::size_t variable, std::span<const std::size_t> begin, std::span<const std::size_t> counts,
            std::span<T> values) const;

 private:
  std::filesystem::path path_;
  [[maybe_unused]] std::size_t bytes_ = 0;
  [[maybe_unused]] int id_ = -1;
};

extern template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                             std::span<std::int32_t>) const;
extern template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                             std::span<std::int64_t>) const;
extern template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                             std::span<float>) const;
extern template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                             std::span<double>) const;
extern template void NetcdfLibraryFile::read(std::size_t, std::span<const std::size_t>, std::span<const std::size_t>,
                                             std::span<char>) const;

/// New values of a part of a variable: see NetcdfLibraryFile::read.
struct NetcdfOverwrite {
  std::size_t variable = 0;
  std::vector<std::size_t> begin;
  std::vector<std::size_t> counts;
  std::vector<double> values;
};

/// Writes these values, as numbers of the variables' types, into the netCDF-4 file on the disk; all else in it stays.
/// Throws WriteError.
void overwrite_netcdf(const std::filesystem::path& path, std::span<const NetcdfOverwrite> parts);

}  // namespace trismooth

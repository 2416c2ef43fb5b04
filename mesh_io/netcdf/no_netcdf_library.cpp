// SPDX-License-Identifier: BSD-3-Clause
// In the place of netcdf_library.cpp where the build has no netCDF library.
#include <stdexcept>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/netcdf/netcdf_library.h"

namespace trismooth {

NetcdfLibraryFile::NetcdfLibraryFile(std::filesystem::path path, std::string_view /*bytes*/) {
  throw ReadError(path,
                  "is netCDF-4 (HDF5), which this build cannot read: build with TRISMOOTH_NETCDF; "
                  "'nccopy -k cdf5 in.nc out.nc' makes a classic file, which every build reads");
}

NetcdfLibraryFile::~NetcdfLibraryFile() = default;

NetcdfContent NetcdfLibraryFile::content() const {
  return {};
}

template <class T>
void NetcdfLibraryFile::read(std::size_t /*variable*/, std::span<const std::size_t> /*begin*/,
                             std::span<const std::size_t> /*counts*/, std::span<T> /*values*/) const {}

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

void overwrite_netcdf(const std::filesystem::path& /*path*/, std::span<const NetcdfOverwrite> /*parts*/) {
  throw std::logic_error("this build has no netCDF library, and no file that it read");
}

}  // namespace trismooth

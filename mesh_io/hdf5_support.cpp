// SPDX-License-Identifier: BSD-3-Clause
// The one place that knows what a build without HDF5 says of the formats and files that are kept in it.
#ifndef TRISMOOTH_HAS_HDF5

#include <stdexcept>

#include "trismooth/mesh_io/cgns/cgns_description.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/med/med_description.h"
#include "trismooth/mesh_io/netcdf/netcdf4_file.h"

namespace trismooth {

const Codec med_codec{med_description};
const Codec cgns_codec{cgns_description};

std::unique_ptr<const Netcdf4File> open_netcdf4(const std::filesystem::path& path, std::string_view /*bytes*/) {
  throw ReadError(path,
                  "is netCDF-4, which is HDF5, and this build has none (TRISMOOTH_HDF5): "
                  "'nccopy -k cdf5 in.nc out.nc' makes a classic file, which every build reads");
}

std::shared_ptr<const OriginalFile> make_hdf5_original(FileBytes /*bytes*/, std::size_t /*points*/,
                                                       std::vector<Hdf5Column> /*columns*/) {
  throw std::logic_error("this build has no HDF5, and no file that it read");
}

}  // namespace trismooth

#endif

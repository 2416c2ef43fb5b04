// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/netcdf/netcdf_content.h"

namespace trismooth {

/// Whether the bytes begin as a classic netCDF file: of 32-bit offsets, of 64-bit offsets, or CDF5.
bool is_classic_netcdf(std::string_view bytes);

/// The header of a classic file, `bytes` being the whole of it. Of each variable all values are within the bytes,
/// behind the header, and no two variables share any. Throws ReadError. Complexity: n log n in the header.
NetcdfContent read_netcdf_header(const std::filesystem::path& path, std::string_view bytes);

}  // namespace trismooth

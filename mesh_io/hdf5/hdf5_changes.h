// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// All values of datasets, by their paths, row by row.
using Hdf5Values = std::map<std::string, std::vector<double>>;

/// Writes to `file`, a plain path of any kind, the HDF5 file `bytes` with these values, as many as there are, over
/// those of datasets of float32 or float64: in the type that they have, with their chunks and filters. The library does
/// so in a child (Hdf5Child). Throws WriteError, which names the file.
void write_changed_hdf5(const std::filesystem::path& file, std::string_view bytes, const Hdf5Values& values);

}  // namespace trismooth

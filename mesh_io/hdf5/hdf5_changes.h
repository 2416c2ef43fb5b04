// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

namespace trismooth {

/// Sites of `count` numbers, or rows of as many as `columns`, of a dataset of float32 or float64, from its `begin`-th
/// number on, with `step` numbers from each to the next; nothing where they do not stand in the file as they are.
std::optional<NumberSites> hdf5_sites(const Hdf5Reader& reader, const std::string& dataset, std::size_t begin,
                                      std::size_t step, std::size_t count, std::vector<SiteColumn> columns);

/// All values of datasets, by their paths, row by row.
using Hdf5Values = std::map<std::string, std::vector<double>>;

/// Writes to `file`, a plain path of any kind, the HDF5 file `bytes` with these values, as many as there are, over
/// those of datasets of float32 or float64: in the type that they have, with their chunks and filters. The library does
/// so in a child (Hdf5Child). Throws WriteError, which names the file.
void write_changed_hdf5(const std::filesystem::path& file, std::string_view bytes, const Hdf5Values& values);

}  // namespace trismooth

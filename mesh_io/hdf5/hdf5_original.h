// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

class Hdf5Reader;

/// Numbers of a dataset of float32 or float64 that stand side by side, for points that follow each other: of an axis,
/// of a component of a point array, or of several of them in turns.
struct Hdf5Column {
  std::string dataset;
  std::size_t begin = 0;   ///< of the first number in the dataset, row by row
  NumberSites numbers;     ///< how many there are, of what and of which points; where, if they are in one piece
  bool is_packed = false;  ///< they are not
};

/// `count` rows of numbers, one a column, which the dataset has from that number on; the first is of `first_point`.
Hdf5Column hdf5_column(const Hdf5Reader& reader, const std::string& dataset, std::size_t begin, std::size_t count,
                       std::vector<SiteColumn> columns, std::size_t first_point = 0);

/// Writes to `path` the HDF5 file `bytes` with what the document has in these columns, by HDF5 itself; the same bytes
/// where no number differs. Throws WriteError.
void write_hdf5_columns(const std::filesystem::path& path, std::string_view bytes, std::span<const Hdf5Column> columns,
                        const MeshDocument& document);

/// The original of an HDF5 file: `bytes`, the whole file, in which numbers of these columns that differ are
/// overwritten: where they are, if all of them are in one piece and apart, else by HDF5, with what else it keeps as it
/// is; the same bytes where none differs. Columns of coordinates have `points` points together. No arrays can be added.
std::shared_ptr<const OriginalFile> make_hdf5_original(FileBytes bytes, std::size_t points,
                                                       std::vector<Hdf5Column> columns);

}  // namespace trismooth

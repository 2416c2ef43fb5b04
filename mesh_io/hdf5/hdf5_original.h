// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Numbers of a dataset that stand side by side, one for each of points that follow each other: of an axis, or of a
/// component of a point array.
struct Hdf5Column {
  std::string dataset;
  std::size_t begin = 0;  ///< of the first number in the dataset, row by row
  std::size_t count = 0;
  SiteColumn column{};  ///< what the numbers are
  std::size_t first_point = 0;
  std::size_t step = 1;  ///< from each number to the next in the dataset
};

/// The original of an HDF5 file: `bytes`, the whole file, in which numbers of these columns that differ are
/// overwritten, with what else HDF5 keeps as it is; the same bytes where none does. All datasets hold float32 or
/// float64. Columns of coordinates have `points` points together. No arrays can be added.
std::shared_ptr<const OriginalFile> make_hdf5_original(FileBytes bytes, std::size_t points,
                                                       std::vector<Hdf5Column> columns);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The array with a row for each of `rows`, which number rows of `array`. Linear in what it gets.
DataArray with_rows(const DataArray& array, std::span<const std::size_t> rows);

}  // namespace trismooth

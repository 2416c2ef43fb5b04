// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trismooth/base/text/plain_name.h"
#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The names in their order, separated by ", "; "none" where there are no arrays.
std::string array_names(std::span<const DataArray> arrays);

/// The array of that name, or else the first whose plain_name() is the same; nullptr where there is none. Complexity:
/// linear.
const DataArray* find_array_loosely(std::span<const DataArray> arrays, std::string_view name);

}  // namespace trismooth

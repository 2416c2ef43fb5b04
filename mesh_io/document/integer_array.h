// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// An array of one component: of int32 where that holds all of `values`, else of int64.
DataArray make_integer_array(std::string name, std::vector<std::int64_t> values);

}  // namespace trismooth

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// Names as they are compared where programs write one in several ways: letters in lower case and digits, nothing else.
/// "Material_ID", "material id" and "MaterialId" are "materialid". Other alphabets' letters stay as they are.
std::string plain_name(std::string_view name);

/// The names in their order, separated by ", "; "none" where there are no arrays.
std::string array_names(std::span<const DataArray> arrays);

/// The array of that name, or else the first whose plain_name() is the same; nullptr where there is none. Complexity:
/// linear.
const DataArray* find_array_loosely(std::span<const DataArray> arrays, std::string_view name);

}  // namespace trismooth

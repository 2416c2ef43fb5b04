// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/global_ids.h"

#include <algorithm>
#include <string_view>

namespace trismooth {

const DataArray* find_global_ids(const MeshDocument& document) {
  for (const DataArray& array : document.point_arrays) {
    if (array.description != nullptr && std::ranges::count(array.description->roles, "GlobalIds") != 0) {
      return &array;
    }
  }
  for (const std::string_view name : {"GlobalNodeIds", "GlobalPointIds"}) {
    if (const DataArray* const array = find_array(document.point_arrays, name)) {
      return array;
    }
  }
  return nullptr;
}

}  // namespace trismooth

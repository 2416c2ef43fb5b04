// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_names.h"

#include <algorithm>

#include "trismooth/base/text/list_text.h"

namespace trismooth {

std::string array_names(std::span<const DataArray> arrays) {
  const std::string names = list_text(arrays, &DataArray::name);
  return names.empty() ? "none" : names;
}

const DataArray* find_array_loosely(std::span<const DataArray> arrays, std::string_view name) {
  if (const DataArray* const exact = find_array(arrays, name)) {
    return exact;
  }
  const std::string plain = plain_name(name);
  const auto found = std::ranges::find(arrays, plain, [](const DataArray& array) { return plain_name(array.name); });
  return plain.empty() || found == arrays.end() ? nullptr : &*found;
}

}  // namespace trismooth

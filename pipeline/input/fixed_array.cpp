// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/fixed_array.h"

#include <algorithm>
#include <stdexcept>

#include "trismooth/mesh_io/document/array_names.h"

namespace trismooth {

const DataArray* choose_fixed_array(std::span<const DataArray> arrays, const std::optional<std::string>& name) {
  return find_array_loosely(arrays, name.value_or("fixed"));
}

FixedArray find_fixed_array(const MeshDocument& document, const std::optional<std::string>& name) {
  if (name == no_fixed_array) {
    return {};
  }
  const DataArray* const array = choose_fixed_array(document.point_arrays, name);
  if (array == nullptr) {
    if (name) {
      throw std::invalid_argument("the file has no point array '" + *name +
                                  "' to take fixed vertices from; it has: " + array_names(document.point_arrays) +
                                  "; " + std::string(no_fixed_array) + " holds nothing by an array");
    }
    return {};
  }
  FixedArray fixed{array->name, std::vector<std::uint8_t>(document.point_count(), 0)};
  for (std::size_t v = 0; v < fixed.flags.size(); ++v) {
    for (std::size_t i = 0; i < array->components; ++i) {
      fixed.flags[v] |= array->value(v, i) != 0 ? std::uint8_t{1} : std::uint8_t{0};
    }
  }
  fixed.vertices = std::ranges::count(fixed.flags, 1);
  return fixed;
}

}  // namespace trismooth

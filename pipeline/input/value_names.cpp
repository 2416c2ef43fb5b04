// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/value_names.h"

namespace trismooth {

ValueNames::ValueNames(const DataArray& array, int dimension) {
  if (array.description == nullptr) {
    return;
  }
  for (const ValueName& name : array.description->value_names) {
    if (name.dimension == dimension) {
      names_.emplace(std::to_string(name.value), name.name);
    }
  }
}

std::string ValueNames::of(std::string_view value) const {
  const auto found = names_.find(value);
  return found == names_.end() ? std::string() : found->second;
}

}  // namespace trismooth

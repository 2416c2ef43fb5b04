// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// What an array calls its values at cells of one dimension.
class ValueNames {
 public:
  /// Complexity: n log n for n names.
  ValueNames(const DataArray& array, int dimension);

  /// The name of a value, as value_text() writes it; empty where it has none. Logarithmic in the names.
  std::string of(std::string_view value) const;

 private:
  std::map<std::string, std::string, std::less<>> names_;
};

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/integer_array.h"

#include <algorithm>
#include <utility>

namespace trismooth {

DataArray make_integer_array(std::string name, std::vector<std::int64_t> values) {
  if (!std::ranges::all_of(values, [](std::int64_t value) { return std::in_range<std::int32_t>(value); })) {
    return make_data_array(std::move(name), 1, std::move(values));
  }
  std::vector<std::int32_t> narrow(values.size());
  std::ranges::transform(values, narrow.begin(), [](std::int64_t value) { return static_cast<std::int32_t>(value); });
  return make_data_array(std::move(name), 1, std::move(narrow));
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_components.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace trismooth {

ScalarType widened_type(const DataArray& array) {
  switch (array.type) {
    case ScalarType::uint32:
    case ScalarType::int64:
      return ScalarType::int64;
    case ScalarType::uint64: {
      constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
      const bool fits =
          std::ranges::all_of(array.as<std::uint64_t>(), [](std::uint64_t value) { return value <= most; });
      return fits ? ScalarType::int64 : ScalarType::float64;
    }
    case ScalarType::float32:
    case ScalarType::float64:
      return array.type;
    default:
      return ScalarType::int32;
  }
}

bool is_exact_as_double(const DataArray& array) {
  const auto is_exact = [](auto value) {
    const auto half = std::numeric_limits<decltype(value)>::max() / 2 + 1;
    const auto behind = 2.0 * static_cast<double>(half);
    const auto real = static_cast<double>(value);
    return real < behind && static_cast<decltype(value)>(real) == value;
  };
  return array.type == ScalarType::int64    ? std::ranges::all_of(array.as<std::int64_t>(), is_exact)
         : array.type == ScalarType::uint64 ? std::ranges::all_of(array.as<std::uint64_t>(), is_exact)
                                            : true;
}

}  // namespace trismooth

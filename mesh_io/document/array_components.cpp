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

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The ScalarType of the C++ type.
template <class T>
constexpr ScalarType scalar_type_of() {
  if constexpr (std::is_floating_point_v<T>) {
    return sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64;
  } else {
    constexpr int width = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return static_cast<ScalarType>(2 * width + (std::is_unsigned_v<T> ? 1 : 0));
  }
}

}  // namespace trismooth

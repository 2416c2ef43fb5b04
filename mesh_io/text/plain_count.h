// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The next number of PlainNumbers or BinaryNumbers, of an integer type; negative where it is of another type,
/// cannot be read, or is not from 0 to 2^63 - 1.
template <class Numbers>
std::int64_t next_plain_count(Numbers& numbers, ScalarType type) {
  return visit_scalar_type(type, [&](auto value) -> std::int64_t {
    if constexpr (std::is_integral_v<decltype(value)>) {
      return numbers.next(value) ? static_cast<std::int64_t>(value) : -1;
    }
    return -1;
  });
}

}  // namespace trismooth

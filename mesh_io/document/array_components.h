// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// Which of int32, int64, float32 and float64 holds the numbers of the array, for formats that have these alone: the
/// first that has those of its type. Of uint64 with numbers beyond int64 it is float64, which rounds them. Complexity:
/// linear for uint64, else constant.
ScalarType widened_type(const DataArray& array);

/// Whether a double holds every number of the array. Complexity: linear for numbers of 64 bits, else constant.
bool is_exact_as_double(const DataArray& array);

/// The component of those rows of the array, as T. Complexity: linear in the rows.
template <class T>
std::vector<T> component_of(const DataArray& array, std::size_t component, std::span<const std::size_t> rows) {
  std::vector<T> values;
  values.reserve(rows.size());
  visit_scalar_type(array.type, [&](auto zero) {
    const auto all = array.as<decltype(zero)>();
    for (const std::size_t row : rows) {
      values.push_back(static_cast<T>(all[row * array.components + component]));
    }
  });
  return values;
}

/// Calls function(zero), a number of the type that the array is widened to, which is one of the four.
template <class Function>
void with_widened_type(const DataArray& array, const Function& function) {
  switch (widened_type(array)) {
    case ScalarType::int32:
      return function(std::int32_t{});
    case ScalarType::int64:
      return function(std::int64_t{});
    case ScalarType::float32:
      return function(float{});
    default:
      return function(double{});
  }
}

}  // namespace trismooth

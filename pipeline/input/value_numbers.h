// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// Items grouped by their values: equal values have equal numbers, from 0 in ascending order of the values.
struct ValueNumbers {
  std::vector<std::int32_t> of_item;
  std::vector<std::int32_t> example;  ///< the lowest item that has the value of each number

  std::int32_t count() const { return static_cast<std::int32_t>(example.size()); }
};

/// Numbers the values of a one-component array at the rows `rows`; items are the places in `rows`, which must be rows
/// of the array. In the array's own type: whole numbers beyond 2^53 are not equal for being equal as doubles. All
/// not-a-numbers are one value, the last; -0 is 0. Complexity: linear, and r log r for r changes of the value from an
/// item to the next.
ValueNumbers number_values(const DataArray& array, std::span<const std::int32_t> rows);

/// Numbers the pairs of values of the same items: ascending by the first, then by the second. Complexity: as above.
ValueNumbers number_pairs(const ValueNumbers& first, const ValueNumbers& second);

/// The numbers of the first items, of which the others are copies: `copy_of` has one item for each of the others. An
/// item whose copies have other values has the set of these in place of one: a number behind those of all values.
/// Complexity: linear, and n log n in the copies.
ValueNumbers join_copies(const ValueNumbers& numbers, std::span<const std::int32_t> copy_of);

/// Whether every value is a whole number.
bool are_whole(const DataArray& array, std::span<const std::int32_t> rows, const ValueNumbers& numbers);

/// The value at a row of a one-component array as text, exact: "7", "0.5", "nan".
std::string value_text(const DataArray& array, std::size_t row);

}  // namespace trismooth

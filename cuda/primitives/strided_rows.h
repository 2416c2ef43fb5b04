// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/cuda/runtime/context.h"

namespace trismooth::cuda {

/// Rows of numbers in device memory of the caller's, as libraries of arrays lay them: number k of row i lies
/// i row_stride + k column_stride bytes behind `first`, aligned to its type.
struct StridedRows {
  std::byte* first = nullptr;
  std::int64_t rows = 0;
  std::int32_t columns = 0;
  std::int64_t row_stride = 0;
  std::int64_t column_stride = 0;
};

/// Queues packed[i columns + k] = number k of row i, for T float, double and uint8. At most 2^32 - 1 numbers.
template <class T>
void gather_rows(const Context& context, const StridedRows& rows, T* packed);

/// Queues the way back.
template <class T>
void scatter_rows(const Context& context, const T* packed, const StridedRows& rows);

/// gather_rows() for integers of any type, as int32. One that has no place there becomes
/// `no_place_in_32_bits`, which is none of any vertices; `of_largest`: what the largest unsigned one becomes then.
inline constexpr std::int32_t no_place_in_32_bits = INT32_MIN;
void gather_integers(const Context& context, const StridedRows& rows, bool is_signed, std::size_t bytes_of_each,
                     std::int32_t* packed, std::int32_t of_largest = no_place_in_32_bits);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "trismooth/cuda/primitives/strided_rows.h"
#include "trismooth/cuda/runtime/for_each.cuh"

namespace trismooth::cuda {

namespace {

/// Where number `index` of the rows, counted row by row, is.
__device__ std::byte* place(const StridedRows& rows, std::uint32_t index) {
  const std::int64_t row = index / static_cast<std::uint32_t>(rows.columns);
  const std::int64_t column = index % static_cast<std::uint32_t>(rows.columns);
  return rows.first + row * rows.row_stride + column * rows.column_stride;
}

template <class T>
struct Gather {
  StridedRows rows;
  T* packed;

  __device__ void operator()(std::uint32_t i) const { packed[i] = *reinterpret_cast<const T*>(place(rows, i)); }
};

template <class T>
struct Scatter {
  const T* packed;
  StridedRows rows;

  __device__ void operator()(std::uint32_t i) const { *reinterpret_cast<T*>(place(rows, i)) = packed[i]; }
};

template <class T>
struct GatherIntegers {
  StridedRows rows;
  std::int32_t* packed;
  std::int32_t of_largest;

  __device__ void operator()(std::uint32_t i) const {
    const T number = *reinterpret_cast<const T*>(place(rows, i));
    const auto narrow = static_cast<std::int32_t>(number);
    const bool has_place = static_cast<T>(narrow) == number && (std::is_signed_v<T> || narrow >= 0);
    const bool is_largest = !std::is_signed_v<T> && number == std::numeric_limits<T>::max();
    packed[i] = has_place ? narrow : is_largest ? of_largest : no_place_in_32_bits;
  }
};

std::uint32_t number_count(const StridedRows& rows) {
  const std::int64_t count = rows.rows * rows.columns;
  if (count > INT64_C(0xffffffff)) {
    throw std::invalid_argument("more than 4294967295 numbers in an array");
  }
  return static_cast<std::uint32_t>(count);
}

template <class T>
void gather_integers_of(const Context& context, const StridedRows& rows, std::int32_t* packed,
                        std::int32_t of_largest) {
  for_each(context, number_count(rows), GatherIntegers<T>{rows, packed, of_largest});
}

}  // namespace

template <class T>
void gather_rows(const Context& context, const StridedRows& rows, T* packed) {
  for_each(context, number_count(rows), Gather<T>{rows, packed});
}

template <class T>
void scatter_rows(const Context& context, const T* packed, const StridedRows& rows) {
  for_each(context, number_count(rows), Scatter<T>{packed, rows});
}

template void gather_rows(const Context&, const StridedRows&, float*);
template void gather_rows(const Context&, const StridedRows&, double*);
template void gather_rows(const Context&, const StridedRows&, std::uint8_t*);
template void scatter_rows(const Context&, const float*, const StridedRows&);
template void scatter_rows(const Context&, const double*, const StridedRows&);

void gather_integers(const Context& context, const StridedRows& rows, bool is_signed, std::size_t bytes_of_each,
                     std::int32_t* packed, std::int32_t of_largest) {
  switch (bytes_of_each) {
    case 1:
      is_signed ? gather_integers_of<std::int8_t>(context, rows, packed, of_largest)
                : gather_integers_of<std::uint8_t>(context, rows, packed, of_largest);
      break;
    case 2:
      is_signed ? gather_integers_of<std::int16_t>(context, rows, packed, of_largest)
                : gather_integers_of<std::uint16_t>(context, rows, packed, of_largest);
      break;
    case 4:
      is_signed ? gather_integers_of<std::int32_t>(context, rows, packed, of_largest)
                : gather_integers_of<std::uint32_t>(context, rows, packed, of_largest);
      break;
    default:
      is_signed ? gather_integers_of<std::int64_t>(context, rows, packed, of_largest)
                : gather_integers_of<std::uint64_t>(context, rows, packed, of_largest);
      break;
  }
}

}  // namespace trismooth::cuda

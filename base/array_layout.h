// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <type_traits>
#include <utility>

#include "trismooth/base/point2.h"

namespace trismooth {

/// Rows of numbers in the memory of the caller: number k of row i lies i row_stride + k column_stride bytes behind
/// `first`.
template <class T>
struct NumberRows {
  T* first = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t column_stride = 0;
};

/// A type that is `size` numbers one behind the other in memory and nothing else. Specialise it for a point type of
/// your own, and contiguous ranges of it are taken like those of std::array.
template <class P>
struct NumberTuple {
  static constexpr std::size_t size = 0;  ///< no such type
};
template <class T, std::size_t n>
struct NumberTuple<std::array<T, n>> {
  using Number = T;
  static constexpr std::size_t size = n;
};
template <class T, std::size_t n>
struct NumberTuple<T[n]> {
  using Number = T;
  static constexpr std::size_t size = n;
};
template <class T>
struct NumberTuple<Point2<T>> {
  using Number = T;
  static constexpr std::size_t size = 2;
};

/// How the arrays of callers lie in memory, read from their types.
namespace array_layout {

/// A matrix, an array or a map of Eigen, told by its members: Eigen need not be there.
template <class M>
concept EigenMatrix = requires(std::remove_cvref_t<M>& m) {
  typename std::remove_cvref_t<M>::Scalar;
  std::remove_cvref_t<M>::RowsAtCompileTime;
  std::remove_cvref_t<M>::ColsAtCompileTime;
  std::remove_cvref_t<M>::IsRowMajor;
  m.data();
  m.innerStride();
  m.outerStride();
};

/// An EigenMatrix with memory of its own: no map, no block.
template <class M>
concept OwningMatrix = EigenMatrix<M> && requires(std::remove_cvref_t<M>& m) {
  m.conservativeResize(m.rows(), m.cols());
};

template <EigenMatrix M>
inline constexpr int rows_of = static_cast<int>(std::remove_cvref_t<M>::RowsAtCompileTime);
template <EigenMatrix M>
inline constexpr int columns_of = static_cast<int>(std::remove_cvref_t<M>::ColsAtCompileTime);
template <EigenMatrix M>
inline constexpr bool is_vector = rows_of<M> == 1 || columns_of<M> == 1;

}  // namespace array_layout

/// Eigen's vectors of fixed size.
template <array_layout::EigenMatrix V>
requires(array_layout::is_vector<V>&& array_layout::rows_of<V> > 0 && array_layout::columns_of<V> > 0 &&
         array_layout::OwningMatrix<V>) struct NumberTuple<V> {
  using Number = typename V::Scalar;
  static constexpr std::size_t size = array_layout::rows_of<V> * array_layout::columns_of<V>;
};

namespace array_layout {

/// What R views outlives the expression that makes it, as far as its type tells.
template <class R>
concept Lasting = std::is_lvalue_reference_v<R> ||(EigenMatrix<R> && !OwningMatrix<R>) ||
                  (!EigenMatrix<R> && std::ranges::borrowed_range<R>);

template <class R>
concept ContiguousRange = !EigenMatrix<R> && std::ranges::contiguous_range<R> && std::ranges::sized_range<R>;

template <class R>
concept EigenVector = EigenMatrix<R> && is_vector<R>;

/// Where the first number of a range of numbers or of a vector is.
template <class R>
constexpr auto first_number(R& range) {
  if constexpr (EigenMatrix<R>) {
    return range.data();
  } else {
    return std::ranges::data(range);
  }
}

/// The type of the numbers, const where they cannot be written, of a range of numbers or of a vector.
template <class R>
using NumberOf = std::remove_pointer_t<decltype(first_number(std::declval<R&>()))>;

/// A range of numbers, or a vector of Eigen.
template <class R>
concept Numbers = (ContiguousRange<R> && std::is_arithmetic_v<std::ranges::range_value_t<R>>) || EigenVector<R>;

/// A range of tuples of numbers.
template <class R>
concept Tuples =
    ContiguousRange<R> &&(NumberTuple<std::ranges::range_value_t<R>>::size > 0) &&
    sizeof(std::ranges::range_value_t<R>) == NumberTuple<std::ranges::range_value_t<R>>::size *
                                                 sizeof(typename NumberTuple<std::ranges::range_value_t<R>>::Number);

/// The numbers of tuples, const where they cannot be written.
template <Tuples R>
using TupleNumberOf = std::conditional_t<std::is_const_v<std::remove_reference_t<std::ranges::range_reference_t<R>>>,
                                         const typename NumberTuple<std::ranges::range_value_t<R>>::Number,
                                         typename NumberTuple<std::ranges::range_value_t<R>>::Number>;

/// A matrix with two dimensions.
template <class M>
concept Matrix = EigenMatrix<M> && !is_vector<M>;

template <Matrix M>
using MatrixNumberOf = std::remove_pointer_t<decltype(std::declval<std::remove_reference_t<M>&>().data())>;

template <Numbers R>
std::size_t number_count(R& numbers) {
  return static_cast<std::size_t>(numbers.size());
}

/// Numbers one behind the other, cut into rows; what is left over belongs to none.
template <Numbers R>
NumberRows<NumberOf<R>> flat_rows(R& numbers, std::size_t columns) {
  std::ptrdiff_t step = sizeof(NumberOf<R>);
  if constexpr (EigenMatrix<R>) {
    step *= numbers.innerStride();
  }
  return {first_number(numbers), number_count(numbers) / columns, columns, static_cast<std::ptrdiff_t>(columns) * step,
          step};
}

template <Tuples R>
NumberRows<TupleNumberOf<R>> tuple_rows(R& tuples) {
  using Tuple = std::ranges::range_value_t<R>;
  return {reinterpret_cast<TupleNumberOf<R>*>(std::ranges::data(tuples)),
          static_cast<std::size_t>(std::ranges::size(tuples)), NumberTuple<Tuple>::size, sizeof(Tuple),
          sizeof(TupleNumberOf<R>)};
}

/// The rows of a matrix.
template <Matrix M>
NumberRows<MatrixNumberOf<M>> matrix_rows(M& matrix) {
  constexpr std::ptrdiff_t size = sizeof(MatrixNumberOf<M>);
  constexpr bool is_row_major = std::remove_cvref_t<M>::IsRowMajor != 0;
  const std::ptrdiff_t inner = matrix.innerStride() * size;
  const std::ptrdiff_t outer = matrix.outerStride() * size;
  return {matrix.data(), static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()),
          is_row_major ? outer : inner, is_row_major ? inner : outer};
}

/// The columns of a matrix, as rows.
template <Matrix M>
NumberRows<MatrixNumberOf<M>> matrix_columns(M& matrix) {
  const NumberRows<MatrixNumberOf<M>> rows = matrix_rows(matrix);
  return {rows.first, rows.columns, rows.rows, rows.column_stride, rows.row_stride};
}

constexpr bool is_between(int value, int low, int high) {
  return low <= value && value <= high;
}

/// A matrix whose type says that each column has `low` to `high` numbers, and nothing like it of the rows.
template <class M, int low, int high>
concept ColumnsOf = Matrix<M> && is_between(rows_of<M>, low, high) && !is_between(columns_of<M>, low, high);
/// A matrix whose type says that each row has `low` to `high` numbers, and nothing like it of the columns.
template <class M, int low, int high>
concept RowsOf = Matrix<M> && is_between(columns_of<M>, low, high) && !is_between(rows_of<M>, low, high);

/// The columns or the rows of a matrix, whichever its type says has the right number of numbers.
template <int low, int high, Matrix M>
NumberRows<MatrixNumberOf<M>> rows_by_type(M& matrix) {
  if constexpr (ColumnsOf<M, low, high>) {
    return matrix_columns(matrix);
  } else {
    return matrix_rows(matrix);
  }
}

}  // namespace array_layout

}  // namespace trismooth

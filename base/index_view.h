// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/element_list.h"
#include "trismooth/base/triangle_view.h"

namespace trismooth {

namespace array_layout {

/// What vertices are numbered with: signed or unsigned, of 32 or 64 bits.
template <class T>
concept Index = std::integral<std::remove_cv_t<T>> && !std::same_as<std::remove_cv_t<T>, bool> &&
                (sizeof(T) == sizeof(std::int32_t) || sizeof(T) == sizeof(std::int64_t));

template <class R>
concept IndexNumbers = Numbers<R> && Index<NumberOf<R>> && Lasting<R>;
template <class R>
concept IndexTuples = Tuples<R> && Index<TupleNumberOf<R>> && Lasting<R> &&
    (NumberTuple<std::ranges::range_value_t<R>>::size == 3 || NumberTuple<std::ranges::range_value_t<R>>::size == 4);
template <class M>
concept IndexMatrix = Matrix<M> && Index<MatrixNumberOf<M>> && Lasting<M>;
template <class M>
concept TriangleMatrix = IndexMatrix<M> &&(ColumnsOf<M, 3, 3> || RowsOf<M, 3, 3>);

}  // namespace array_layout

/// The elements of a mesh where the caller keeps them: three vertex numbers each, from 0, of any type of 32 or 64 bits,
/// or four where quadrilaterals are among them: of a triangle the last is then -1 (of unsigned numbers the largest).
/// Nothing is copied to make one. The caller owns the memory and keeps it for as long as the view is used; a
/// function that takes a view does not look at the memory any more when it has returned.
///
/// These convert to it by themselves: numbers one behind the other, three for each triangle (std::vector<std::int32_t>,
/// std::span<const std::size_t>, ...), three or four of them together (std::vector<std::array<int, 3>>, ...) and Eigen
/// matrices whose type says which way they lie (Eigen::Matrix3Xi, Eigen::Matrix<long, Eigen::Dynamic, 3>, ...). A
/// temporary that owns its numbers is not taken: they would be gone with it.
class IndexView {
 public:
  /// Throws std::invalid_argument unless there are three for each triangle.
  template <class R>
  requires array_layout::IndexNumbers<R> IndexView(R&& numbers) : IndexView(array_layout::flat_rows(numbers, 3)) {
    require_whole_triangles(array_layout::number_count(numbers));
  }

  /// Elements of a type that is three numbers, or four.
  template <class R>
  requires array_layout::IndexTuples<R> IndexView(R&& triangles) : IndexView(array_layout::tuple_rows(triangles)) {}

  /// An Eigen matrix of three rows or columns by its type.
  template <class M>
  requires array_layout::TriangleMatrix<M> IndexView(M&& matrix)
      : IndexView(array_layout::rows_by_type<3, 3>(matrix)) {}

  /// One element a row. Throws std::invalid_argument where a row has neither three numbers nor four and where there are
  /// elements but no memory.
  template <class T>
  requires array_layout::Index<T>
  explicit IndexView(const NumberRows<T>& rows)
      : first_(reinterpret_cast<const std::byte*>(rows.first)),
        size_(rows.rows),
        columns_(rows.columns),
        element_stride_(rows.row_stride),
        corner_stride_(rows.column_stride),
        is_wide_(sizeof(T) == sizeof(std::int64_t)),
        is_signed_(std::is_signed_v<T>) {
    check();
  }

  /// What is listed.
  explicit IndexView(const ElementList& elements)
      : IndexView(elements.visit([](const auto& listed) { return IndexView(listed); })) {}

  /// Elements.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Whether there are four numbers of each, so that some may be quadrilaterals.
  [[nodiscard]] bool may_have_quadrilaterals() const { return columns_ == 4; }

  /// The elements as the library holds them, listed by as many numbers as here: the caller's own memory where it has
  /// that form, else converted into `converted`, which keeps them. Throws MeshError for a number that is not one of the
  /// vertices and has no place in 32 bits; of all others it is found later. Complexity: constant or linear.
  [[nodiscard]] ElementList list(std::int64_t vertex_count, OwnElements& converted) const;

 private:
  static void require_whole_triangles(std::size_t numbers);
  void check() const;
  template <class Corners>
  ElementList listed(std::int64_t vertex_count, OwnElements& converted) const;
  template <class T, class Corners>
  void convert(std::int64_t vertex_count, std::vector<Corners>& converted) const;

  const std::byte* first_;
  std::size_t size_;
  std::size_t columns_;
  std::ptrdiff_t element_stride_;
  std::ptrdiff_t corner_stride_;
  bool is_wide_;
  bool is_signed_;
};

/// A copy of the elements. Throws as IndexView::list(). Complexity: linear.
OwnElements own_elements(const IndexView& indices, std::int64_t vertex_count);

/// An Eigen matrix of indices with an element a row (libigl's F), where its type does not tell (MatrixXi). Throws
/// std::invalid_argument unless rows have three numbers or four.
template <array_layout::IndexMatrix M>
[[nodiscard]] IndexView triangle_rows(M&& matrix) {
  return IndexView(array_layout::matrix_rows(matrix));
}
/// An Eigen matrix of indices with an element a column, where its type does not tell. Throws std::invalid_argument
/// unless columns have three numbers or four.
template <array_layout::IndexMatrix M>
[[nodiscard]] IndexView triangle_columns(M&& matrix) {
  return IndexView(array_layout::matrix_columns(matrix));
}

}  // namespace trismooth

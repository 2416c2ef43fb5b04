// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"

namespace trismooth {

class Workers;

namespace array_layout {

/// Coordinates that can be read, or written as well.
template <class T>
concept Coordinate = std::same_as < std::remove_const_t<T>,
float > || std::same_as<std::remove_const_t<T>, double>;
template <class T>
concept WritableCoordinate = Coordinate<T> && !std::is_const_v<T>;

template <class R>
concept CoordinateNumbers = Numbers<R> && Coordinate<NumberOf<R>> && Lasting<R>;
template <class R>
concept CoordinateTuples = Tuples<R> && Coordinate<TupleNumberOf<R>> && Lasting<R> &&
    (NumberTuple<std::ranges::range_value_t<R>>::size == 2 || NumberTuple<std::ranges::range_value_t<R>>::size == 3);
template <class M>
concept CoordinateMatrix = Matrix<M> && Coordinate<MatrixNumberOf<M>> && Lasting<M>;
template <class M>
concept PointMatrix = CoordinateMatrix<M> &&(ColumnsOf<M, 2, 3> || RowsOf<M, 2, 3>);

/// What may be meant as points and does not say by its type where their numbers are.
template <class R>
concept OtherPoints = (ContiguousRange<R> && std::is_class_v<std::ranges::range_value_t<R>> &&
                       NumberTuple<std::ranges::range_value_t<R>>::size == 0) ||
                      (CoordinateMatrix<R> && !PointMatrix<R>);

/// Does not compile, and says what to write.
template <OtherPoints R>
constexpr void refuse_points() {
  static_assert(!ContiguousRange<R>,
                "trismooth: the type of these points does not say where their numbers are: "
                "xy_points(&nodes[0].x, nodes.size(), sizeof(Node)) does, or a NumberTuple of the type");
  static_assert(!CoordinateMatrix<R>,
                "trismooth: the type of this matrix does not say whether its rows or its columns are points: "
                "point_rows(matrix) or point_columns(matrix) does");
}

}  // namespace array_layout

/// The points of a mesh where the caller keeps them, for reading: two or three numbers each, `float` or `double`, any
/// distance apart. Nothing is copied to make one. Cheap to copy itself; the caller owns the memory and keeps it for as
/// long as the view is used.
///
/// What says by its type how many numbers a point has converts to it by itself:
///
///     std::vector<std::array<double, 2>>, std::span<const trismooth::Point2<float>>, double[100][3],
///     std::vector<Eigen::Vector3d>, Eigen::Matrix2Xd, Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3>>, ...
///
/// A plain array of numbers does not say: xy_points() or xyz_points() has to. A temporary that owns its numbers is not
/// taken: they would be gone with it.
class ConstPointView {
 public:
  /// Points of a type that is two or three numbers.
  template <class R>
  requires array_layout::CoordinateTuples<R> ConstPointView(R&& points)
      : ConstPointView(array_layout::tuple_rows(points)) {}

  /// An Eigen matrix of two or three rows or columns by its type.
  template <class M>
  requires array_layout::PointMatrix<M> ConstPointView(M&& matrix)
      : ConstPointView(array_layout::rows_by_type<2, 3>(matrix)) {}

  /// One point a row. Throws std::invalid_argument where a row has not two or three numbers, where there are points but
  /// no memory, and where a number is not aligned as its type must be.
  template <class T>
  requires array_layout::Coordinate<T>
  explicit ConstPointView(const NumberRows<T>& rows)
      : ConstPointView(reinterpret_cast<const std::byte*>(rows.first), rows.rows, rows.columns, rows.row_stride,
                       rows.column_stride,
                       std::same_as<std::remove_const_t<T>, float> ? Storage::float32 : Storage::float64) {}

  /// Points.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Numbers of each: 2 or 3.
  [[nodiscard]] std::size_t components() const { return components_; }
  /// The type of the numbers.
  [[nodiscard]] Storage storage() const { return storage_; }

  /// x and y of all points. Throws MeshError for the first point with a number, z included, that is not finite.
  /// Complexity: linear, on all `workers`.
  [[nodiscard]] std::vector<Point2<double>> read(Workers& workers) const;
  /// z of point `v`; of points with three components.
  [[nodiscard]] double z(std::size_t v) const { return number(v, 2); }

 protected:
  /// Points of which all has been checked.
  ConstPointView(const std::byte* first, std::size_t size, std::size_t components, std::ptrdiff_t point_stride,
                 std::ptrdiff_t component_stride, Storage storage);

  /// Where number `k` of point `v` is.
  const std::byte* at(std::size_t v, std::size_t k) const {
    return first_ + static_cast<std::ptrdiff_t>(v) * point_stride_ + static_cast<std::ptrdiff_t>(k) * component_stride_;
  }
  /// Whether the memory is an array of Point2<double>, without a gap.
  bool are_pairs() const;

 private:
  double number(std::size_t v, std::size_t k) const {
    return storage_ == Storage::float32 ? static_cast<double>(*reinterpret_cast<const float*>(at(v, k)))
                                        : *reinterpret_cast<const double*>(at(v, k));
  }

  const std::byte* first_;
  std::size_t size_;
  std::size_t components_;
  std::ptrdiff_t point_stride_;
  std::ptrdiff_t component_stride_;
  Storage storage_;
};

/// A ConstPointView of points that are written as well: made from numbers that are not const.
class PointView : public ConstPointView {
 public:
  /// Points of a type that is two or three numbers.
  template <class R>
  requires array_layout::CoordinateTuples<R> && array_layout::WritableCoordinate<array_layout::TupleNumberOf<R>>
  PointView(R&& points) : ConstPointView(array_layout::tuple_rows(points)) {}

  /// An Eigen matrix of two or three rows or columns by its type.
  template <class M>
  requires array_layout::PointMatrix<M> && array_layout::WritableCoordinate<array_layout::MatrixNumberOf<M>> PointView(
      M&& matrix)
      : ConstPointView(array_layout::rows_by_type<2, 3>(matrix)) {}

  /// One point a row. Throws std::invalid_argument as the constructor of ConstPointView does.
  template <class T>
  requires array_layout::WritableCoordinate<T>
  explicit PointView(const NumberRows<T>& rows) : ConstPointView(rows) {}

  /// Writes x and y of all points, rounded to storage(); z stays. Complexity: linear, on all `workers`.
  void write(std::span<const Point2<double>> points, Workers& workers) const;
  /// All points, where the memory is an array of them: pairs of double without a gap. Else nothing.
  [[nodiscard]] std::span<Point2<double>> as_pairs() const;

 private:
  // It was made from memory that can be written.
  template <class T>
  T& number_at(std::size_t v, std::size_t k) const {
    return *reinterpret_cast<T*>(const_cast<std::byte*>(at(v, k)));
  }
};

namespace array_layout {

/// Throws std::invalid_argument unless numbers come out even.
void require_whole_points(std::size_t numbers, std::size_t components);

/// Points of numbers of type T: to be written, unless T is const.
template <Coordinate T>
using PointsOf = std::conditional_t<std::is_const_v<T>, ConstPointView, PointView>;

template <Numbers R>
PointsOf<NumberOf<R>> flat_points(R& numbers, std::size_t components) {
  require_whole_points(number_count(numbers), components);
  return PointsOf<NumberOf<R>>(flat_rows(numbers, components));
}

/// Throws std::invalid_argument for points that overlap.
void require_apart(std::size_t points, std::ptrdiff_t stride_bytes, std::size_t point_bytes);

template <Coordinate T>
PointsOf<T> strided_points(T* first, std::size_t count, std::ptrdiff_t stride_bytes, std::size_t components) {
  require_apart(count, stride_bytes, components * sizeof(T));
  return PointsOf<T>(NumberRows<T>{first, count, components, stride_bytes, sizeof(T)});
}

}  // namespace array_layout

/// An array of float or double (std::vector, std::span, Eigen::VectorXd, a map of one, ...) as points: x and y of every
/// vertex, one behind the other. To be read alone where the numbers are const. Throws std::invalid_argument for an odd
/// number of them.
template <array_layout::CoordinateNumbers R>
[[nodiscard]] array_layout::PointsOf<array_layout::NumberOf<R>> xy_points(R&& numbers) {
  return array_layout::flat_points(numbers, 2);
}

/// An array of float or double as points: x, y and z of every vertex, one behind the other. To be read alone where the
/// numbers are const. Throws std::invalid_argument unless there are three for each.
template <array_layout::CoordinateNumbers R>
[[nodiscard]] array_layout::PointsOf<array_layout::NumberOf<R>> xyz_points(R&& numbers) {
  return array_layout::flat_points(numbers, 3);
}

/// `count` points whose x lies `stride_bytes` behind that of the point before, with y next to it: for arrays of
/// structs, as in xy_points(&nodes[0].x, nodes.size(), sizeof(Node)). A negative stride runs backwards. Throws
/// std::invalid_argument where points would overlap or be out of alignment.
template <array_layout::Coordinate T>
[[nodiscard]] array_layout::PointsOf<T> xy_points(T* first, std::size_t count,
                                                  std::ptrdiff_t stride_bytes = 2 * sizeof(T)) {
  return array_layout::strided_points(first, count, stride_bytes, 2);
}

/// `count` points whose x lies `stride_bytes` behind that of the point before, with y and z next to it. A negative
/// stride runs backwards. Throws std::invalid_argument where points would overlap or be out of alignment.
template <array_layout::Coordinate T>
[[nodiscard]] array_layout::PointsOf<T> xyz_points(T* first, std::size_t count,
                                                   std::ptrdiff_t stride_bytes = 3 * sizeof(T)) {
  return array_layout::strided_points(first, count, stride_bytes, 3);
}

/// An Eigen matrix with a point a row (libigl's V), where its type does not tell (MatrixXd). Throws
/// std::invalid_argument unless rows have two or three numbers.
template <array_layout::CoordinateMatrix M>
[[nodiscard]] array_layout::PointsOf<array_layout::MatrixNumberOf<M>> point_rows(M&& matrix) {
  return array_layout::PointsOf<array_layout::MatrixNumberOf<M>>(array_layout::matrix_rows(matrix));
}
/// An Eigen matrix with a point a column, where its type does not tell. Throws std::invalid_argument unless columns
/// have two or three numbers.
template <array_layout::CoordinateMatrix M>
[[nodiscard]] array_layout::PointsOf<array_layout::MatrixNumberOf<M>> point_columns(M&& matrix) {
  return array_layout::PointsOf<array_layout::MatrixNumberOf<M>>(array_layout::matrix_columns(matrix));
}

}  // namespace trismooth

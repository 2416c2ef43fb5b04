// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include "trismooth/base/array_layout.h"

namespace trismooth {

/// A mesh of OpenMesh's where the caller keeps it, whatever its traits are: its connectivity with status and
/// properties, and its points, one a row. Nothing is copied to make one.
struct OpenMeshView {
  const OpenMesh::PolyConnectivity* mesh = nullptr;
  std::variant<NumberRows<float>, NumberRows<double>> points;
};

/// OpenMeshView of a mesh that is left as it is.
struct ConstOpenMeshView {
  const OpenMesh::PolyConnectivity* mesh = nullptr;
  std::variant<NumberRows<const float>, NumberRows<const double>> points;
};

/// What the templates over meshes ask of a type.
namespace open_mesh {

/// A mesh with an array kernel, const or not.
template <class Mesh>
concept ArrayKernelMesh = std::derived_from<std::remove_const_t<Mesh>, OpenMesh::PolyConnectivity> && requires {
  typename Mesh::Point;
};

template <class Point>
using NumberOfPoint = typename OpenMesh::vector_traits<Point>::value_type;

/// Two or three numbers of float or double that operator[] gives by reference.
template <class Point>
concept PlainPoint = (std::same_as<NumberOfPoint<Point>, float> ||
                      std::same_as<NumberOfPoint<Point>, double>)&&(OpenMesh::vector_traits<Point>::size_ == 2 ||
                                                                    OpenMesh::vector_traits<Point>::size_ == 3) &&
                     requires(Point& point) {
  { point[0] } -> std::same_as<NumberOfPoint<Point>&>;
};

/// Whether these are its points; of what is no mesh something else is wrong.
template <class Mesh>
constexpr bool has_plain_points() {
  if constexpr (ArrayKernelMesh<Mesh>) {
    return PlainPoint<typename Mesh::Point>;
  } else {
    return true;
  }
}

/// The points of a mesh; of numbers that are const where `Number` is. Throws std::invalid_argument where the numbers of
/// a point are not the same distance apart.
template <class Number, class Mesh>
NumberRows<Number> points_of(const Mesh& mesh) {
  using Point = typename Mesh::Point;
  constexpr std::size_t numbers = OpenMesh::vector_traits<Point>::size_;
  if (mesh.n_vertices() == 0) {
    return {nullptr, 0, numbers, sizeof(Point), sizeof(Number)};
  }
  // operator[] of a const point may give a copy. Nothing is written here.
  auto& first = const_cast<Point&>(mesh.point(OpenMesh::VertexHandle(0)));
  const auto step = reinterpret_cast<const std::byte*>(&first[1]) - reinterpret_cast<const std::byte*>(&first[0]);
  const auto begin = reinterpret_cast<const std::byte*>(&first[0]) - reinterpret_cast<const std::byte*>(&first);
  const auto last =
      reinterpret_cast<const std::byte*>(&first[numbers - 1]) - reinterpret_cast<const std::byte*>(&first);
  const auto is_within = [](std::ptrdiff_t place) {
    return place >= 0 &&
           place + static_cast<std::ptrdiff_t>(sizeof(Number)) <= static_cast<std::ptrdiff_t>(sizeof(Point));
  };
  if (last - begin != static_cast<std::ptrdiff_t>(numbers - 1) * step || !is_within(begin) || !is_within(last)) {
    throw std::invalid_argument("points: the numbers of a point are to be in it, the same distance apart");
  }
  return {&first[0], mesh.n_vertices(), numbers, sizeof(Point), step};
}

/// The view of a mesh. What cannot be viewed does not compile: one sentence says why.
template <class View, class Mesh>
View view_of(Mesh& mesh) {
  constexpr bool is_mesh = ArrayKernelMesh<Mesh>;
  static_assert(is_mesh,
                "trismooth: this is no OpenMesh mesh with an array kernel, as TriMesh_ArrayKernelT and "
                "PolyMesh_ArrayKernelT with any traits are; flat arrays are two arguments, points and triangles");
  constexpr bool has_points = has_plain_points<Mesh>();
  static_assert(has_points,
                "trismooth: a point of this OpenMesh mesh is to be two or three numbers of float or double, which its "
                "operator[] gives by reference");
  constexpr bool is_written = std::same_as<View, OpenMeshView>;
  constexpr bool may_be_written = !is_mesh || !has_points || !is_written || !std::is_const_v<Mesh>;
  static_assert(may_be_written,
                "trismooth: this OpenMesh mesh is const, and smoothing moves its points where they are");
  if constexpr (is_mesh && has_points && may_be_written) {
    using Number = NumberOfPoint<typename Mesh::Point>;
    return {&mesh, points_of<std::conditional_t<is_written, Number, const Number>>(mesh)};
  } else {
    return {};
  }
}

}  // namespace open_mesh

}  // namespace trismooth

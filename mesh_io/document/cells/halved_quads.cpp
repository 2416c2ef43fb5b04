// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/halved_quads.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/document/cells/replaced_cells.h"

namespace trismooth {

namespace {

bool is_quad(const MeshDocument& document, std::size_t cell) {
  return ordinary_type(document.cells.types[cell], document.cells[cell].size()) == cell_type::quad;
}

/// Of the points of a document.
class Corners {
 public:
  Corners(const MeshDocument& document, std::span<const std::int32_t> quad) : points_(document.points), quad_(quad) {}

  double squared_length(int from, int to) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum += side(from, to)[axis] * side(from, to)[axis];
    }
    return sum;
  }
  /// Whether a diagonal has the other corners on two sides.
  bool cuts(int from, int to) const {
    const std::array<double, 3> one = normal(from, from + 1, to);
    const std::array<double, 3> other = normal(from, to, to + 1);
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2] > 0;
  }

 private:
  std::array<double, 3> side(int from, int to) const {
    std::array<double, 3> between{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      between[axis] = points_[3 * static_cast<std::size_t>(quad_[to % 4]) + axis] -
                      points_[3 * static_cast<std::size_t>(quad_[from % 4]) + axis];
    }
    return between;
  }
  std::array<double, 3> normal(int a, int b, int c) const {
    const std::array<double, 3> u = side(a, b);
    const std::array<double, 3> v = side(a, c);
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }

  std::span<const double> points_;
  std::span<const std::int32_t> quad_;
};

/// The corner where the diagonal begins that cuts it.
int begin_of_cut(const Corners& corners) {
  const int shorter = corners.squared_length(1, 3) < corners.squared_length(0, 2) ? 1 : 0;
  const int longer = 1 - shorter;
  return !corners.cuts(shorter, shorter + 2) && corners.cuts(longer, longer + 2) ? longer : shorter;
}

}  // namespace

std::size_t count_quads(const MeshDocument& document) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    count += is_quad(document, cell) ? 1 : 0;
  }
  return count;
}

bool has_curved_quads(const MeshDocument& document) {
  return std::ranges::any_of(document.cells.types, [](std::uint8_t type) {
    return type == cell_type::quadratic_quad || type == cell_type::biquadratic_quad;
  });
}

MeshDocument with_halved_quads(const MeshDocument& document) {
  return with_replaced_cells(document, [&document](std::size_t cell, CellList& cells) {
    if (!is_quad(document, cell)) {
      return false;
    }
    const auto quad = document.cells[cell];
    const int begin = begin_of_cut(Corners(document, quad));
    const auto corner = [&](int i) { return quad[static_cast<std::size_t>((begin + i) % 4)]; };
    cells.append(cell_type::triangle, Triangle{corner(0), corner(1), corner(2)});
    cells.append(cell_type::triangle, Triangle{corner(0), corner(2), corner(3)});
    return true;
  });
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_element_types.h"

#include <algorithm>
#include <array>
#include <utility>

#include "trismooth/base/cell_list.h"

namespace trismooth {

namespace {

using MshOrder = std::vector<std::uint16_t>;

/// A corner, or a vertex between, on a grid of (order + 1)^2 places.
struct GridPlace {
  std::size_t x;
  std::size_t y;

  bool operator==(const GridPlace&) const = default;
};

/// As Gmsh numbers the vertices of a complete quadrangle: corners, edges around, and the same again for what is inside.
std::vector<GridPlace> msh_quad(std::size_t order, std::size_t shift = 0) {
  if (order == 0) {
    return {{shift, shift}};
  }
  const std::size_t end = shift + order;
  std::vector<GridPlace> places{{shift, shift}, {end, shift}, {end, end}, {shift, end}};
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({shift + i, shift});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({end, shift + i});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({end - i, end});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({shift, end - i});
  }
  if (order >= 2) {
    const std::vector<GridPlace> inside = msh_quad(order - 2, shift + 1);
    places.insert(places.end(), inside.begin(), inside.end());
  }
  return places;
}

/// As VTK does: corners, edges with x or y growing, and what is inside row by row.
std::vector<GridPlace> vtk_quad(std::size_t order) {
  std::vector<GridPlace> places{{0, 0}, {order, 0}, {order, order}, {0, order}};
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({i, 0});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({order, i});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({i, order});
  }
  for (std::size_t i = 1; i < order; ++i) {
    places.push_back({0, i});
  }
  for (std::size_t y = 1; y < order; ++y) {
    for (std::size_t x = 1; x < order; ++x) {
      places.push_back({x, y});
    }
  }
  return places;
}

MshOrder order_of_quad(std::size_t order) {
  const std::vector<GridPlace> listed = msh_quad(order);
  MshOrder found;
  for (const GridPlace& place : vtk_quad(order)) {
    found.push_back(static_cast<std::uint16_t>(std::ranges::find(listed, place) - listed.begin()));
  }
  return found;
}

/// A polygon around a face whose vertices are corners and `between` on each edge.
MshOrder order_of_boundary(std::size_t corners, std::size_t between) {
  MshOrder found;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    found.push_back(static_cast<std::uint16_t>(corner));
    for (std::size_t i = 0; i < between; ++i) {
      found.push_back(static_cast<std::uint16_t>(corners + corner * between + i));
    }
  }
  return found;
}

struct NumberedType {
  int number;
  int dimension;
  std::size_t vertices;
};

/// Lines, complete triangles, complete quadrangles: of orders from 3.
constexpr std::array<int, 8> curves{26, 27, 28, 62, 63, 64, 65, 66};
constexpr std::array<int, 8> triangles{21, 23, 25, 42, 43, 44, 45, 46};
constexpr std::array<int, 8> quads{36, 37, 38, 47, 48, 49, 50, 51};
/// Those of the sides alone, without vertices inside.
constexpr std::array<int, 8> triangle_boundaries{20, 22, 24, 52, 53, 54, 55, 56};
constexpr std::array<int, 8> quad_boundaries{39, 40, 41, 57, 58, 59, 60, 61};
/// Of one vertex: order 0.
constexpr std::array<int, 7> constants{84, 85, 86, 87, 88, 89, 132};

/// Solids that VTK has not, or not in this order of vertices; and small ones for mixed methods.
constexpr auto other_solids = std::to_array<NumberedType>({
    {14, 3, 14},   {29, 3, 20},   {30, 3, 35},  {31, 3, 56},   {32, 3, 22},   {33, 3, 28},   {71, 3, 84},
    {72, 3, 120},  {73, 3, 165},  {74, 3, 220}, {75, 3, 286},  {79, 3, 34},   {80, 3, 40},   {81, 3, 46},
    {82, 3, 52},   {83, 3, 58},   {90, 3, 40},  {91, 3, 75},   {92, 3, 64},   {93, 3, 125},  {94, 3, 216},
    {95, 3, 343},  {96, 3, 512},  {97, 3, 729}, {98, 3, 1000}, {99, 3, 32},   {100, 3, 44},  {101, 3, 56},
    {102, 3, 68},  {103, 3, 80},  {104, 3, 92}, {105, 3, 104}, {106, 3, 126}, {107, 3, 196}, {108, 3, 288},
    {109, 3, 405}, {110, 3, 550}, {111, 3, 24}, {112, 3, 33},  {113, 3, 42},  {114, 3, 51},  {115, 3, 60},
    {116, 3, 69},  {117, 3, 78},  {118, 3, 30}, {119, 3, 55},  {120, 3, 91},  {121, 3, 140}, {122, 3, 204},
    {123, 3, 285}, {124, 3, 385}, {125, 3, 21}, {126, 3, 29},  {127, 3, 37},  {128, 3, 45},  {129, 3, 53},
    {130, 3, 61},  {131, 3, 69},  {137, 3, 16}, {138, 2, 4},   {139, 3, 5},   {140, 3, 4},
});

class MshElementTypes {
 public:
  MshElementTypes() {
    add(1, {1, 2, cell_type::line});
    add(2, {2, 3, cell_type::triangle});
    add(3, {2, 4, cell_type::quad});
    add(4, {3, 4, cell_type::tetrahedron});
    add(5, {3, 8, cell_type::hexahedron});
    add(6, {3, 6, cell_type::wedge});
    add(7, {3, 5, cell_type::pyramid});
    add(8, {1, 3, cell_type::quadratic_edge});
    add(9, {2, 6, cell_type::quadratic_triangle});
    add(10, {2, 9, cell_type::biquadratic_quad});
    add(11, {3, 10, cell_type::quadratic_tetrahedron, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}});
    add(12, {3, 27, cell_type::triquadratic_hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                                         19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}});
    add(13, {3,
             18,
             cell_type::biquadratic_quadratic_wedge,
             {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16}});
    add(15, {0, 1, cell_type::vertex});
    add(16, {2, 8, cell_type::quadratic_quad});
    add(17, {3, 20, cell_type::quadratic_hexahedron, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                      13, 9, 16, 18, 19, 17, 10, 12, 14, 15}});
    add(18, {3, 15, cell_type::quadratic_wedge, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}});
    add(19, {3, 13, cell_type::quadratic_pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}});
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const std::size_t order = i + 3;
      add(curves[i], {1, order + 1, cell_type::lagrange_curve});
      add(triangles[i], {2, (order + 1) * (order + 2) / 2, cell_type::lagrange_triangle});
      add(quads[i], {2, (order + 1) * (order + 1), cell_type::lagrange_quad, order_of_quad(order)});
      add(triangle_boundaries[i], {2, 3 * order, cell_type::polygon, order_of_boundary(3, order - 1)});
      add(quad_boundaries[i], {2, 4 * order, cell_type::polygon, order_of_boundary(4, order - 1)});
    }
    for (const int number : constants) {
      add(number, {0, 1, cell_type::vertex});
    }
    for (const NumberedType& other : other_solids) {
      add(other.number, {other.dimension, other.vertices, cell_type::convex_point_set});
    }
  }

  const MshElementType& operator[](std::int64_t number) const {
    return types_[number > 0 && number < static_cast<std::int64_t>(types_.size()) ? static_cast<std::size_t>(number)
                                                                                  : 0];
  }

  int number_of(std::uint8_t cell, std::size_t vertices) const {
    // Polygons and point sets of any number of vertices are no elements of Gmsh, whatever their number is.
    if (cell == cell_type::polygon || cell == cell_type::convex_point_set) {
      return cell == cell_type::convex_point_set ? 0 : vertices == 3 ? 2 : vertices == 4 ? 3 : 0;
    }
    for (std::size_t number = 1; number < types_.size(); ++number) {
      if (types_[number].cell == cell && types_[number].vertices == vertices) {
        return static_cast<int>(number);
      }
    }
    return 0;
  }

 private:
  void add(int number, MshElementType type) {
    type.places.resize(type.order.size());
    for (std::size_t i = 0; i < type.order.size(); ++i) {
      type.places[type.order[i]] = static_cast<std::uint16_t>(i);
    }
    types_[static_cast<std::size_t>(number)] = std::move(type);
  }

  std::array<MshElementType, 141> types_{};
};

const MshElementTypes& element_types() {
  static const MshElementTypes types;
  return types;
}

}  // namespace

const MshElementType& msh_element_type(std::int64_t number) {
  return element_types()[number];
}

int msh_number_of(std::uint8_t cell, std::size_t vertices) {
  return element_types().number_of(cell, vertices);
}

}  // namespace trismooth

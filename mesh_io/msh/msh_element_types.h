// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trismooth {

/// How a document holds an element of Gmsh.
struct MshElementType {
  int dimension = 0;
  std::size_t vertices = 0;            ///< 0: no such type, or one whose elements have any number of them
  std::uint8_t cell = 0;               ///< the VTK cell type
  std::vector<std::uint16_t> order{};  ///< vertex i of the cell is vertex order[i] of the element; empty: the same
  std::vector<std::uint16_t>
      places{};  ///< the other way round: vertex i of the element is vertex places[i] of the cell
};

/// The types that Gmsh numbers from 1. Where VTK has no such cell, a face is a polygon around its boundary, or else all
/// vertices are a convex point set.
const MshElementType& msh_element_type(std::int64_t number);

/// The number of the type that a cell of the VTK type with that many vertices is written as; 0 where there is none.
int msh_number_of(std::uint8_t cell, std::size_t vertices);

/// Elements of these types state how many vertices they have.
constexpr bool is_msh_polygon(std::int64_t number) {
  return number == 34 || number == 69;
}

}  // namespace trismooth

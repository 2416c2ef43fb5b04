// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace trismooth {

/// A type of elements of CGNS (ElementType_t).
struct CgnsElement {
  std::int64_t number = 0;
  std::uint8_t type = 0;  ///< of the cells that they are
  std::size_t nodes = 0;
  const std::uint8_t* places{};  ///< of vertex i of the cell among the element's nodes; null: i
  bool is_written = true;        ///< cells of the type are written as such elements

  std::size_t place(std::size_t i) const { return places == nullptr ? i : places[i]; }
};

namespace cgns_type {
inline constexpr std::int64_t mixed = 20;
inline constexpr std::int64_t polygons = 22;
}  // namespace cgns_type

/// Those of a fixed number of nodes, in the order in which they are written.
std::span<const CgnsElement> cgns_elements();

/// The one of that number, or null.
const CgnsElement* find_cgns_element(std::int64_t number);

/// What a section of elements of that type is called that is written.
inline std::string cgns_section_name(std::int64_t type) {
  return "Elements_" + std::to_string(type);
}

/// What a cell of that type with so many vertices is written as; null: none.
const CgnsElement* cgns_element_of_cell(std::uint8_t type, std::size_t vertices);

}  // namespace trismooth

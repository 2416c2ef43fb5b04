// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace trismooth {

/// A geometric type of MED: how a file lists the elements of it.
struct MedElement {
  std::string_view name;         ///< of the group that holds them: "TR3"
  std::int64_t number = 0;       ///< MED's own: 203
  std::uint8_t type = 0;         ///< of the cells that they are
  std::size_t nodes = 0;         ///< of each; 0: polygons
  const std::uint8_t* places{};  ///< of vertex i of the cell among the element's nodes; null: i
  bool is_written = true;        ///< cells of the type are written as such elements

  std::size_t place(std::size_t i) const { return places == nullptr ? i : places[i]; }
};

/// All, in the order in which MED lists them.
std::span<const MedElement> med_elements();

/// The one of the group's name, or null.
const MedElement* find_med_element(std::string_view name);

/// What a cell of that type with so many vertices is written as; null: MED does not hold it.
const MedElement* med_element_of_cell(std::uint8_t type, std::size_t vertices);

}  // namespace trismooth

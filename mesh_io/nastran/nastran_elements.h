// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/base/cell_list.h"

namespace trismooth {

inline constexpr std::size_t most_nastran_nodes = 20;

/// A shape that the nodes of a card may make.
struct NastranShape {
  std::uint8_t type = 0;      ///< its cell_type
  std::size_t corners = 0;    ///< nodes that have to be there
  std::size_t nodes = 0;      ///< with those in the middle of its edges
  bool is_alternate = false;  ///< corners and middles in turn, along the edges; else corners first

  /// Where on the card the node stands that is vertex i of the cell.
  std::size_t place(std::size_t i) const;
};

/// What a card that states an element is.
struct NastranElement {
  std::string_view name;
  NastranShape plain;        ///< without middles
  NastranShape curved = {};  ///< with middles, some of which may be left out; none where nodes is 0
  bool has_property = true;  ///< its second field is a property; else the first node

  std::size_t most_nodes() const { return curved.nodes > 0 ? curved.nodes : plain.nodes; }
  /// The field (from 0 behind the name) of the first node.
  std::size_t first_node() const { return has_property ? 2 : 1; }
  const NastranShape& shape_of(std::uint8_t type) const { return curved.type == type ? curved : plain; }
};

/// The element of that name (in upper case), or nullptr.
const NastranElement* find_nastran_element(std::string_view name);

/// The card that is written for cells of that type; nullptr where there is none.
const NastranElement* nastran_element_of_cell(std::uint8_t type);

}  // namespace trismooth

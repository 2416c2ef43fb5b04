// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "trismooth/mesh_io/nastran/nastran_source.h"

namespace trismooth {

/// Where something stands in a deck.
struct NastranPlace {
  std::size_t source = 0;
  std::size_t offset = 0;
};

/// Numbers from `first` to `last`.
struct NastranRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// A deck with all files that belong to it, as its cards say it.
struct NastranModel {
  std::deque<NastranSource> sources;  ///< the first is the file itself

  std::vector<std::int64_t> node_ids;
  std::vector<double> points;  ///< x, y, z of every node, in the order of the cards

  std::vector<std::uint8_t> element_types;
  std::vector<std::size_t> element_begins{0};  ///< element e has references[element_begins[e] .. element_begins[e + 1])
  std::vector<std::int64_t> references;        ///< ids of nodes, in the order of a cell's vertices
  std::vector<std::int64_t> properties;        ///< of every element; 0: it states none
  std::vector<NastranPlace> element_places;

  std::int64_t system = 0;                                ///< the coordinate system of all nodes
  std::map<std::string, std::vector<NastranRange>> held;  ///< nodes that loads, constraints, ... name, by card and set
  std::map<std::int64_t, std::string> property_names;
  std::set<std::string> other_cards;    ///< names of those that are not interpreted
  std::set<std::string> partly_curved;  ///< names of elements some of whose middles are left out
  bool has_short_free_grids = false;    ///< GRIDs in free field that is not large
};

/// Where the GRID of that vertex stands. Linear in their number: for messages.
inline NastranPlace place_of_nastran_node(const NastranModel& model, std::size_t vertex) {
  for (std::size_t source = 0; source < model.sources.size(); ++source) {
    const std::vector<std::int32_t>& vertices = model.sources[source].vertices;
    const auto found = std::ranges::find(vertices, static_cast<std::int32_t>(vertex));
    if (found != vertices.end()) {
      return {source, static_cast<std::size_t>(
                          model.sources[source].grids[static_cast<std::size_t>(found - vertices.begin())])};
    }
  }
  return {};
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "trismooth/smoothing/parts/part_messenger.h"
#include "trismooth/smoothing/parts/vertex_exchange.h"

namespace trismooth {

/// What a part of a mesh knows of the whole, beside its own vertices and all their triangles. The other vertices of
/// these triangles are its ghosts: another part owns and moves them, and sends what they are. Vertices are numbered in
/// the order of their ids in the whole mesh.
struct MeshPart {
  /// A part that owns ghosts of this one, or the other way round.
  struct Neighbour {
    int part = 0;
    std::vector<std::int32_t> sends;     ///< own vertices that are ghosts there, ascending
    std::vector<std::int32_t> receives;  ///< ghosts that it owns, ascending
  };

  std::vector<std::uint8_t> ghosts;   ///< one a vertex: 1 where another part owns it
  std::vector<std::int32_t> colours;  ///< one a vertex, ghosts too: that of Form B in the whole mesh; -1: fixed
  std::int32_t colour_count = 0;      ///< in the whole mesh
  std::int64_t free_vertices = 0;     ///< in the whole mesh
  int number = 0;                     ///< of this part, from 0
  int count = 1;                      ///< of parts
  int place_on_machine = 0;           ///< of this part among those on its machine, from 0
  bool has_progress = false;          ///< some part has a progress callback
  bool is_whole = false;              ///< it is all of the mesh: there are no others to exchange anything with
  std::vector<Neighbour> neighbours;  ///< ascending by part
  std::shared_ptr<PartMessenger> messenger;

  /// To exchange with the neighbours.
  [[nodiscard]] VertexMessages messages() const {
    std::vector<int> parts;
    for (const Neighbour& neighbour : neighbours) {
      parts.push_back(neighbour.part);
    }
    return {*messenger, std::move(parts)};
  }
  /// What brings ghosts the values of their owners, in the part's numbers.
  [[nodiscard]] VertexExchange ghost_exchange() const {
    VertexExchange exchange;
    const auto add = [](const std::vector<std::int32_t>& vertices, VertexLists& lists) {
      lists.vertices.insert(lists.vertices.end(), vertices.begin(), vertices.end());
      lists.end();
    };
    for (const Neighbour& neighbour : neighbours) {
      add(neighbour.sends, exchange.sends);
      add(neighbour.receives, exchange.receives);
    }
    return exchange;
  }
};

/// The colour of a vertex that has none.
inline constexpr std::int32_t no_colour = -1;

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/implied_sets.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/ranges/msh_range.h"
#include "trismooth/pipeline/input/marked_points.h"
#include "trismooth/pipeline/ranks/mesh_share.h"

namespace trismooth {

namespace {

constexpr std::uint8_t of_line = 4;  ///< of a line or point cell; beside the bits of namespace implied

/// What there is to know of each vertex of the rank.
std::vector<std::uint8_t> facts_of(const PieceFiles& files, const RankMesh& mesh) {
  std::vector<std::uint8_t> facts(mesh.ids.size(), 0);
  for (const Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.implied_by.size(); ++i) {
      facts[static_cast<std::size_t>(piece.vertices[i])] |= piece.implied_by[i];
    }
    const CellList& cells = piece.document.cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cell_type::dimension(cells.types[c]) < 2) {
        for (const std::int32_t point : cells[c]) {
          facts[static_cast<std::size_t>(piece.vertices[static_cast<std::size_t>(point)])] |= of_line;
        }
      }
    }
  }
  return facts;
}

}  // namespace

std::vector<FilePointSet> settle_implied_sets(const PieceFiles& files, const RankMesh& mesh,
                                              const RankTopology& topology, std::vector<std::uint8_t>& held) {
  std::vector<FilePointSet> sets;
  bool has_any = false;
  for (const Piece& piece : files.pieces) {
    has_any = has_any || !piece.implied_by.empty();
  }
  if (!topology.ranks().any(has_any)) {
    return sets;
  }
  const std::vector<std::uint8_t> facts = topology.of_vertices<std::uint8_t>(facts_of(files, mesh));
  std::array<std::int64_t, 2> counts{};
  for (std::size_t v = 0; v < facts.size(); ++v) {
    const auto by_sets = static_cast<std::uint8_t>(facts[v] & (implied::points | implied::curves));
    constexpr std::uint8_t not_inside = hold::boundary | hold::non_manifold | hold::isolated | hold::interface;
    if (by_sets == 0 || (held[v] & not_inside) != 0 || (facts[v] & of_line) != 0) {
      continue;
    }
    held[v] |= hold::named;
    if (topology.overlap().is_own(static_cast<std::int32_t>(v))) {
      counts[0] += (by_sets & implied::points) != 0 ? 1 : 0;
      counts[1] += (by_sets & implied::curves) != 0 ? 1 : 0;
    }
  }
  constexpr std::array<std::string_view, 2> names{points_of_geometry, curves_of_geometry};
  for (std::size_t s = 0; s < names.size(); ++s) {
    if (const std::int64_t count = topology.ranks().sum(counts[s]); count > 0) {
      sets.push_back({std::string(names[s]), count, false, true});
    }
  }
  return sets;
}

std::string unjudged_markers(const PieceFiles& files, const mpi::Communicator& ranks) {
  std::string names;
  for (const PieceArray& array : files.arrays) {
    if (files.was_read_whole || array.of != PieceArray::Of::points ||
        !may_be_markers(array.name, array.type, array.components)) {
      continue;
    }
    const bool marks = std::ranges::any_of(files.pieces, [&](const Piece& piece) {
      const DataArray* const markers = find_array(piece.document.point_arrays, array.name);
      for (std::size_t v = 0; markers != nullptr && v < markers->rows(); ++v) {
        if (markers->value(v) != 0) {
          return true;
        }
      }
      return false;
    });
    if (ranks.any(marks)) {
      names += (names.empty() ? "'" : ", '") + array.name + "'";
    }
  }
  return names;
}

}  // namespace trismooth

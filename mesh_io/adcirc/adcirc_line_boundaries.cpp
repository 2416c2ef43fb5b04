// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/adcirc/adcirc_line_boundaries.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/adcirc/adcirc_boundary.h"
#include "trismooth/mesh_io/document/cells/boundary_edges.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"

namespace trismooth {

namespace {

constexpr std::int64_t adcirc_island = 1;

using DirectedEdge = std::array<std::int32_t, 2>;

/// Whether water flows through what has that name; nothing where it says neither that nor that it is land.
std::optional<bool> is_open_by_name(std::string_view name) {
  const auto begins_with = [name](std::string_view word) { return same_letters(name.substr(0, word.size()), word); };
  if (begins_with("open")) {
    return true;
  }
  return begins_with("land") || begins_with("mainland") || begins_with("island") ? std::optional(false) : std::nullopt;
}

/// Twice the area of a polygon, positive where it is listed counter-clockwise.
double signed_area(const MeshDocument& document, const std::vector<std::int32_t>& vertices) {
  const auto x = [&](std::int32_t v) { return document.points[3 * static_cast<std::size_t>(v)]; };
  const auto y = [&](std::int32_t v) { return document.points[3 * static_cast<std::size_t>(v) + 1]; };
  double area = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    area += (x(vertices[i]) - x(vertices[0])) * (y(vertices[i + 1]) - y(vertices[0])) -
            (x(vertices[i + 1]) - x(vertices[0])) * (y(vertices[i]) - y(vertices[0]));
  }
  return area;
}

/// The edges of the mesh's boundary, each with the mesh to its left, by their vertices in ascending order.
std::vector<std::pair<DirectedEdge, DirectedEdge>> edges_along_mesh(const MeshDocument& document) {
  CellList faces;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const std::uint8_t type = document.cells.types[cell];
    if (type == cell_type::triangle || type == cell_type::quad) {
      const auto listed = document.cells[cell];
      std::vector<std::int32_t> vertices(listed.begin(), listed.end());
      if (signed_area(document, vertices) < 0) {
        std::ranges::reverse(vertices);
      }
      faces.append(type, vertices);
    }
  }
  std::vector<std::pair<DirectedEdge, DirectedEdge>> edges;
  for (const DirectedEdge& edge : find_boundary_edges(faces)) {
    edges.emplace_back(DirectedEdge{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}, edge);
  }
  std::ranges::sort(edges);
  return edges;
}

/// Pieces of edges, one behind the other; nothing where they branch. A closed piece has its first node at its end.
std::optional<std::vector<std::vector<std::int32_t>>> pieces_of(std::vector<DirectedEdge> edges) {
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<std::int32_t> ends;
  for (const DirectedEdge& edge : edges) {
    ends.push_back(edge[1]);
  }
  std::ranges::sort(ends);
  const bool branches =
      std::ranges::adjacent_find(ends) != ends.end() ||
      std::ranges::adjacent_find(edges, {}, [](const DirectedEdge& edge) { return edge[0]; }) != edges.end();
  if (branches) {
    return std::nullopt;
  }
  std::vector<bool> is_done(edges.size());
  std::vector<std::vector<std::int32_t>> pieces;
  const auto follow = [&](std::size_t first) {
    std::vector<std::int32_t> nodes{edges[first][0]};
    for (std::size_t edge = first; !is_done[edge];) {
      is_done[edge] = true;
      nodes.push_back(edges[edge][1]);
      const auto next =
          std::ranges::lower_bound(edges, nodes.back(), {}, [](const DirectedEdge& other) { return other[0]; });
      if (next == edges.end() || (*next)[0] != nodes.back()) {
        break;
      }
      edge = static_cast<std::size_t>(next - edges.begin());
    }
    pieces.push_back(std::move(nodes));
  };
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    if (!std::ranges::binary_search(ends, edges[edge][0])) {
      follow(edge);
    }
  }
  // What is left is closed.
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    if (!is_done[edge]) {
      follow(edge);
    }
  }
  return pieces;
}

/// The lines of a group and what they are.
class LineGroup {
 public:
  LineGroup(const MeshDocument& document, const CellGroups& groups, std::size_t group)
      : name_(groups.groups[group].name) {
    for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
      if (groups.of_cell[cell] == static_cast<std::int32_t>(group) && document.cells.types[cell] == cell_type::line) {
        lines_.push_back(cell);
      }
    }
  }

  /// Appends its pieces, or why there are none.
  void add_to(AdcircLineBoundaries& found, const MeshDocument& document,
              const std::vector<std::pair<DirectedEdge, DirectedEdge>>& along_mesh, bool is_open) const {
    std::vector<DirectedEdge> edges;
    for (const std::size_t line : lines_) {
      const auto vertices = document.cells[line];
      const DirectedEdge wanted{std::min(vertices[0], vertices[1]), std::max(vertices[0], vertices[1])};
      const auto edge = std::ranges::lower_bound(along_mesh, wanted, {}, &std::pair<DirectedEdge, DirectedEdge>::first);
      if (edge == along_mesh.end() || edge->first != wanted) {
        lose(found, "are no edges of the mesh's boundary, not all of them");
        return;
      }
      edges.push_back(edge->second);
    }
    const auto pieces = pieces_of(std::move(edges));
    if (!pieces) {
      lose(found, "branch");
      return;
    }
    for (std::vector<std::int32_t> nodes : *pieces) {
      const bool is_closed = nodes.front() == nodes.back();
      const bool is_island = is_closed && !is_open && signed_area(document, nodes) < 0;
      if (is_closed && (is_island || is_open)) {
        nodes.pop_back();
      }
      found.boundaries.push_back({is_open, is_island ? adcirc_island : 0, std::move(nodes)});
    }
    found.is_written.resize(document.cells.size());
    for (const std::size_t line : lines_) {
      found.is_written[line] = 1;
    }
  }

 private:
  void lose(AdcircLineBoundaries& found, std::string_view why) const {
    found.losses.push_back("ADCIRC gets no boundary from the lines of " + name_ + ", which " + std::string(why));
  }

  std::string name_;
  std::vector<std::size_t> lines_;
};

}  // namespace

AdcircLineBoundaries find_adcirc_line_boundaries(const MeshDocument& document) {
  AdcircLineBoundaries found;
  const bool has_sets = std::ranges::any_of(
      document.point_sets, [](const NamedSet& set) { return parse_adcirc_boundary(set.name).has_value(); });
  const CellGroups groups = has_sets ? CellGroups{} : find_cell_groups(document);
  std::vector<std::pair<DirectedEdge, DirectedEdge>> along_mesh;
  for (std::size_t group = 0; group < groups.groups.size(); ++group) {
    const auto is_open = is_open_by_name(groups.groups[group].name);
    if (groups.groups[group].dimension == 1 && is_open) {
      along_mesh = along_mesh.empty() ? edges_along_mesh(document) : std::move(along_mesh);
      LineGroup(document, groups, group).add_to(found, document, along_mesh, *is_open);
    }
  }
  return found;
}

}  // namespace trismooth

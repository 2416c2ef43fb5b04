// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mfem/mfem_nodes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// The edges of triangles and quadrilaterals, in the order in which these have them first.
class MfemEdges {
 public:
  explicit MfemEdges(const CellList& cells) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      if (cell_type::dimension(cells.types[cell]) == 2) {
        const auto vertices = cells[cell];
        for (std::size_t i = 0; i < vertices.size(); ++i) {
          edges_.push_back({ends_of(vertices[i], vertices[(i + 1) % vertices.size()]), edges_.size()});
        }
      }
    }
    std::ranges::sort(edges_, {}, [](const Edge& edge) { return std::tie(edge.ends, edge.number); });
    std::vector<std::size_t> first_sides(edges_.size());
    for (std::size_t i = 0, first = 0; i < edges_.size(); ++i) {
      first = edges_[i].ends == edges_[first].ends ? first : i;
      first_sides[edges_[i].number] = edges_[first].number;
    }
    of_sides_.resize(edges_.size());
    for (std::size_t side = 0; side < of_sides_.size(); ++side) {
      of_sides_[side] = first_sides[side] == side ? count_++ : of_sides_[first_sides[side]];
    }
    // (Not std::ranges::unique, of which Clang 14 cannot read libstdc++'s.)
    const auto are_same = [](const Edge& one, const Edge& other) { return one.ends == other.ends; };
    edges_.erase(std::unique(edges_.begin(), edges_.end(), are_same), edges_.end());
    for (Edge& edge : edges_) {
      edge.number = of_sides_[edge.number];
    }
  }

  std::size_t count() const { return count_; }
  /// Of each side of the cells.
  const std::vector<std::size_t>& of_sides() const { return of_sides_; }

  /// Nothing where no cell has it.
  std::optional<std::size_t> find(std::int32_t from, std::int32_t to) const {
    const auto found = std::ranges::lower_bound(edges_, ends_of(from, to), {}, &Edge::ends);
    return found != edges_.end() && found->ends == ends_of(from, to) ? std::optional(found->number) : std::nullopt;
  }

 private:
  using Ends = std::pair<std::int32_t, std::int32_t>;

  struct Edge {
    Ends ends;
    std::size_t number;  ///< of a side of the cells, then of the edge
  };

  static Ends ends_of(std::int32_t from, std::int32_t to) { return {std::min(from, to), std::max(from, to)}; }

  std::vector<Edge> edges_;
  std::vector<std::size_t> of_sides_;
  std::size_t count_ = 0;
};

void require_elements_of_all(const CellList& cells, std::size_t vertices, int dimension, const TextScanner& scanner) {
  std::vector<bool> in_element(vertices);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cell_type::dimension(cells.types[cell]) == dimension) {
      for (const std::int32_t vertex : cells[cell]) {
        in_element[static_cast<std::size_t>(vertex)] = true;
      }
    }
  }
  if (const auto missing = std::ranges::find(in_element, false); missing != in_element.end()) {
    scanner.fail("vertex " + std::to_string(missing - in_element.begin()) +
                 " is in no element: MFEM leaves such vertices out of 'nodes'; load and save the mesh with MFEM");
  }
}

void require_faces(const CellList& cells, int dimension, const TextScanner& scanner) {
  const bool only_faces = std::ranges::all_of(cells.types, [dimension](std::uint8_t type) {
    return cell_type::dimension(type) < dimension || type == cell_type::triangle || type == cell_type::quad;
  });
  if (dimension != 2 || !only_faces) {
    scanner.fail(
        "has 'nodes' of elements other than triangles and quadrilaterals: these are read of degree 1 (H1) only; "
        "Mesh::SetCurvature(1) makes them so");
  }
}

/// The cells with the middles of their sides. `edges` are those of the cells.
CellList curved_cells(const CellList& cells, std::size_t vertices, const MfemEdges& edges, const TextScanner& scanner) {
  CellList curved;
  std::size_t side = 0;
  std::size_t middle_of_quad = vertices + edges.count();
  std::vector<std::int32_t> nodes;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const auto corners = cells[cell];
    nodes.assign(corners.begin(), corners.end());
    std::uint8_t type = cells.types[cell];
    if (type == cell_type::triangle || type == cell_type::quad) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        nodes.push_back(static_cast<std::int32_t>(vertices + edges.of_sides()[side++]));
      }
      if (type == cell_type::quad) {
        nodes.push_back(static_cast<std::int32_t>(middle_of_quad++));
      }
      type = type == cell_type::quad ? cell_type::biquadratic_quad : cell_type::quadratic_triangle;
    } else if (type == cell_type::line) {
      const std::optional<std::size_t> edge = edges.find(corners[0], corners[1]);
      if (!edge) {
        scanner.fail("no element has the edge of vertices " + std::to_string(corners[0]) + " and " +
                     std::to_string(corners[1]) + ", which the boundary has: 'nodes' have no middle of it");
      }
      nodes.push_back(static_cast<std::int32_t>(vertices + *edge));
      type = cell_type::quadratic_edge;
    }
    curved.append(type, nodes);
  }
  return curved;
}

/// The nodes of a cell as broken spaces list their places: row by row, from the first corner on.
std::span<const std::uint8_t> rows_of(std::uint8_t type) {
  static constexpr std::array<std::uint8_t, 3> triangle{0, 1, 2};
  static constexpr std::array<std::uint8_t, 4> quad{0, 1, 3, 2};
  static constexpr std::array<std::uint8_t, 6> quadratic_triangle{0, 3, 1, 5, 4, 2};
  static constexpr std::array<std::uint8_t, 9> biquadratic_quad{0, 4, 1, 7, 8, 5, 3, 6, 2};
  switch (type) {
    case cell_type::triangle:
      return triangle;
    case cell_type::quad:
      return quad;
    case cell_type::quadratic_triangle:
      return quadratic_triangle;
    default:
      return biquadratic_quad;
  }
}

}  // namespace

MfemNodeSpace mfem_node_space(std::string_view collection, const TextScanner& scanner) {
  std::optional<std::int64_t> degree;
  const bool is_broken = collection.starts_with("L2_T1_");
  if (is_broken || collection.starts_with("H1_")) {
    if (const std::size_t at = collection.find("D_P"); at != std::string_view::npos) {
      degree = parse_integer(collection.substr(at + 3));
    }
  } else if (collection == "Linear" || collection == "Quadratic" || collection == "Cubic") {
    degree = collection == "Linear" ? 1 : collection == "Quadratic" ? 2 : 3;
  }
  if (!degree) {
    scanner.fail("has 'nodes' of the collection " + quoted(collection) +
                 ", whose numbers are not the places of vertices and middles of edges; Mesh::SetCurvature(1) or (2) "
                 "makes them so");
  }
  if (*degree != 1 && *degree != 2) {
    scanner.fail("is a curved mesh of MFEM of degree " + std::to_string(*degree) + " (" + quoted(collection) +
                 "): those of degree 1 and 2 are smoothed; Mesh::SetCurvature(2) makes it one of degree 2");
  }
  return {static_cast<int>(*degree), is_broken};
}

MfemNodes number_mfem_nodes(CellList& cells, std::size_t vertices, int dimension, MfemNodeSpace space,
                            const TextScanner& scanner) {
  require_elements_of_all(cells, vertices, dimension, scanner);
  MfemNodes nodes{vertices, {}};
  if (space.degree == 2 || space.is_broken) {
    require_faces(cells, dimension, scanner);
  }
  if (space.degree == 2) {
    const MfemEdges edges(cells);
    const auto quads = static_cast<std::size_t>(std::ranges::count(cells.types, cell_type::quad));
    nodes.points += edges.count() + quads;
    if (nodes.points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      scanner.fail("has more than 2147483647 places in 'nodes'");
    }
    cells = curved_cells(cells, vertices, edges, scanner);
  }
  for (std::size_t cell = 0; cell < cells.size() && space.is_broken; ++cell) {
    if (cell_type::dimension(cells.types[cell]) == dimension) {
      for (const std::uint8_t node : rows_of(cells.types[cell])) {
        nodes.points_of_places.push_back(cells[cell][node]);
      }
    }
  }
  return nodes;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// The space of a grid function `nodes`, which has the places of a mesh of MFEM.
struct MfemNodeSpace {
  int degree = 1;          ///< 1: places of vertices; 2: of the middles of edges and quadrilaterals, too
  bool is_broken = false;  ///< each element has places of its own, also of vertices that it shares
};

/// That of a collection of finite elements: "Linear", "Quadratic", "H1_2D_P2", "L2_T1_2D_P1", .... Fails at the token
/// that `scanner` read last for others, naming the degree where that is what is too much.
MfemNodeSpace mfem_node_space(std::string_view collection, const TextScanner& scanner);

/// What the places in a file belong to.
struct MfemNodes {
  std::size_t points = 0;
  std::vector<std::int32_t> points_of_places;  ///< empty where place i is that of point i

  std::size_t places() const { return points_of_places.empty() ? points : points_of_places.size(); }
};

/// Numbers the points of a mesh with such `nodes`: vertices, then the middles of edges in the order in which elements
/// have them first, then those of quadrilaterals, as MFEM numbers the places of spaces that are not broken. For degree
/// 2, cells become triangles of six nodes, quadrilaterals of nine and edges of three. `cells` has the elements, those
/// of `dimension`, before anything else; all vertices are below `vertices`. Fails, as above, for vertices in no
/// element, for cells of the boundary that are at none, and, but for degree 1 that is not broken, for other elements
/// than triangles and quadrilaterals. Complexity: n log n.
MfemNodes number_mfem_nodes(CellList& cells, std::size_t vertices, int dimension, MfemNodeSpace space,
                            const TextScanner& scanner);

}  // namespace trismooth

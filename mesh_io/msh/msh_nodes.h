// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/msh/msh_rows.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

namespace trismooth {

/// Nodes on one entity of the geometry that state their place on it too (u; u and v; or u, v and w).
struct MshParametricNodes {
  int dimension = 0;
  std::int64_t entity = 0;
  std::size_t parameters = 0;    ///< of a node
  std::size_t flag_offset = 0;   ///< of the number that says so; in versions before 4 of the dimension
  std::vector<double> values{};  ///< node by node
  std::vector<double> points{};  ///< the coordinates that they go with
};

/// Where the numbers of successive nodes stand in the file.
struct MshNodeList {
  std::size_t first_vertex = 0;
  NumberSites sites;                ///< x, y, z and the parameters behind them
  MshParametricNodes parametric{};  ///< `parameters` is 0 where they are not
  std::size_t size() const { return sites.size(); }
};

/// The nodes of a file. Their coordinates are the document's points.
struct MshNodes {
  MshTags tags;
  std::vector<MshNodeList> lists;       ///< of all nodes, in the file's order
  std::vector<std::int32_t> on_points;  ///< nodes of points of the geometry, ascending, where the file says so
  std::vector<std::int32_t> on_curves;  ///< nodes of its curves
  bool any_on_surfaces = false;         ///< some node is said to be of a surface or a volume
};

/// Reads the section $Nodes, or $ParametricNodes of versions 2, or $NOD of version 1 (with parameters or without),
/// behind its first line up to its end.
void read_msh_nodes(MshInput& input, MshRows& rows, bool parametric, MeshDocument& document, MshNodes& nodes);

}  // namespace trismooth

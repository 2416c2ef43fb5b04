// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "properties/smoothing_cases.h"
#include "support/random_meshes.h"

namespace properties {

/// A mesh with vertices added that no cell uses.
struct WithUnused {
  RandomMesh mesh;
  std::vector<std::int32_t> number;  ///< the new number of each old vertex

  bool is_old(std::int32_t vertex) const;
  /// The run of the enlarged mesh as one of the old.
  Run without(const Run& run) const;
};

/// Adds some: anywhere among the others, or behind them all, which leaves the others their numbers; where a vertex of
/// the mesh is, or up to the largest double away. Some are named as fixed.
WithUnused with_unused_vertices(const RandomMesh& mesh, bool at_the_end, test_meshes::Random& random);

}  // namespace properties

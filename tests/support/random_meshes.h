// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/smoothing/constraints.h"

#include "support/test_meshes.h"

/// Small random meshes of every kind that a stranger's file may hold, each made of a seed alone, the same everywhere.
namespace random_meshes {

using test_meshes::Mesh;

/// A mesh and what is held fixed of it.
struct RandomMesh {
  std::uint64_t seed = 0;
  std::string kind;  ///< how it was made: a base, and what was done to it
  Mesh mesh;
  std::vector<std::uint8_t> fixed;  ///< this and the following as in trismooth::Constraints, all may be empty
  std::vector<std::int32_t> fixed_ids;
  std::vector<std::uint8_t> other_cells;
  std::vector<std::int32_t> regions;
  trismooth::Sliding slide{};  ///< off, unless a test says otherwise; without lines and links

  /// Views of this mesh's arrays.
  trismooth::Constraints constraints() const { return {fixed, fixed_ids, other_cells, regions, slide}; }
};

/// A mesh of 0 to about 300 vertices, most of them small: Delaunay meshes, grids, stars, rings around holes, closed
/// surfaces, subdivided triangles and soups; with cracks, holes, welded and duplicated vertices, duplicated triangles,
/// edges of three triangles, isolated vertices, several components, regions, in mixed orientation; tangled, degenerate,
/// of extreme aspects, gradings, offsets and scales, on lattices that make many ties; and combinations. Coordinates are
/// finite, no triangle repeats a vertex, every component can be oriented. No element is smaller than 2^-450 times the
/// mesh, so that no square of a length in the local frame underflows in double.
RandomMesh random_mesh(std::uint64_t seed);

/// Whether every component (connected through edges with exactly two triangles) can be oriented.
bool is_orientable(const std::vector<trismooth::Triangle>& triangles);

}  // namespace random_meshes

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/pipeline/held_vertices.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

struct Regions;
struct RunContext;

/// What is found of a mesh when it is connected, of the whole of it.
struct MeshFacts {
  std::int64_t vertices = 0;
  std::int64_t elements = 0;
  std::int64_t quadrilaterals = 0;  ///< of the elements
  std::int64_t other_cells = 0;
  std::int64_t lines = 0;  ///< of the other cells
  std::int64_t components = 0;
  std::int64_t reoriented_triangles = 0;
  ReasonCounts reasons{};      ///< the vertices by what holds them, but for those that follow others
  const LayersResult& layers;  ///< what was held of them, and what was not
  const Regions& regions;
};

/// Whether no two elements share a side, so that nothing is free: something has gone wrong where the mesh was made.
bool are_apart(const MeshFacts& facts);

/// Puts them into the result, with what is to be said of regions, of vertices where elements meet irregularly and of
/// layers.
void summarise_mesh(RunContext& run, const MeshFacts& facts);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

/// The colours of Form B (coloured Gauss-Seidel), as colour_free_vertices() finds them on the host.
struct DeviceColouring {
  /// On meshes of millions of vertices there are under 20.
  static constexpr int most_rounds = 64;

  DeviceBuffer<std::int32_t> colours;  ///< one a vertex of the rings, from 0; -1 for those without a ring
  std::int32_t count = 0;              ///< colours used
  int rounds = 0;                      ///< on the device
};

/// Greedy colouring of the vertices with a ring in the order of splitmix64(vertex), by all threads: in each round those
/// are coloured whose neighbours before them, and vertices opposite in quadrilaterals, all are (Jones and Plassmann
/// 1993). `rings` are in input numbering. What is left after most_rounds, where a chain of vertices runs against the
/// order, the host colours: linear for every mesh.
DeviceColouring colour_vertices(Context& context, const RingsView& rings);
DeviceColouring colour_vertices(Context& context, const MixedRingsView& rings);

}  // namespace trismooth::cuda

#pragma once

#include <cstdint>

#include "trismooth/cuda/device_buffer.h"
#include "trismooth/cuda/rings.h"

namespace trismooth::cuda {

/// The colours of Form B, as colour_free_vertices() finds them on the host.
struct DeviceColouring {
  DeviceBuffer<std::int32_t> colours;  ///< one a vertex of the rings, from 0; -1 for those without a ring
  std::int32_t count = 0;              ///< colours used
};

/// Greedy colouring of the vertices with a ring in the order of splitmix64(vertex), by all threads: in each round those
/// are coloured whose neighbours before them all are (Jones and Plassmann 1993). `rings` are in input numbering.
DeviceColouring colour_vertices(Context& context, const RingsView& rings);

}  // namespace trismooth::cuda

#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/device_buffer.h"
#include "trismooth/cuda/rings.h"
#include "trismooth/quality/point2.h"

namespace trismooth::cuda {

/// One-rings in device memory, renumbered for the sweeps as PackedRings are on the host: free vertices first, batch
/// after batch, each along a Hilbert curve; fixed vertices last. No result depends on the order.
struct PackedDeviceRings {
  DeviceRings rings;                        ///< of the free vertices, in packed numbers
  DeviceBuffer<std::int32_t> input_index;   ///< the caller's number of each packed vertex
  DeviceBuffer<std::int32_t> batch_begins;  ///< `batches` on the device
  std::vector<std::int32_t> batches;        ///< batch b holds packed vertices batches[b] .. batches[b + 1]
  std::int32_t colours = 0;                 ///< 0 where vertices were not coloured

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(input_index.size()); }
  std::int32_t free_count() const { return batches.back(); }
};

/// Packs rings in input numbering, and gives their memory back on the way. `points` (one for every vertex, local frame,
/// on the device) steer the order; their memory goes back too. `by_colour`: a batch for each colour; else one batch of
/// all free vertices.
PackedDeviceRings pack_rings(Context& context, DeviceRings rings, DeviceBuffer<Point2<double>> points, bool by_colour);

}  // namespace trismooth::cuda

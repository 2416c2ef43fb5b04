#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/sweeps/patches/patches.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// One-rings in device memory, renumbered for the sweeps as PackedRings are on the host: free vertices first, batch
/// after batch, each along a Hilbert curve; fixed vertices last. No result depends on the order. One of the three kinds
/// of rings is filled: what the execution and the form read.
struct PackedDeviceRings {
  DeviceRings rings;                        ///< single-block and cdp, and resident on patches
  SlottedRings<std::int16_t> near_rings;    ///< resident, Form A: neighbours have near numbers
  SlottedRings<std::int32_t> wide_rings;    ///< resident, Form B: neighbours are of other colours
  DeviceBuffer<std::int32_t> input_index;   ///< the caller's number of each packed vertex
  DeviceBuffer<std::int32_t> batch_begins;  ///< `batches` on the device
  std::vector<std::int32_t> batches;        ///< batch b holds packed vertices batches[b] .. batches[b + 1]
  std::int32_t colours = 0;                 ///< 0 where vertices were not coloured
  /// Small meshes, resident: all free vertices are one batch. Null where there are none.
  std::unique_ptr<Patches> patches;

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(input_index.size()); }
  std::int32_t free_count() const { return batches.back(); }
};

/// Packs rings in input numbering for a run with these options, and gives their memory back on the way. `points` (one
/// for every vertex, local frame, on the device) steer the order; their memory goes back too. In Form B in colour order
/// there is a batch for each colour, unless there are patches; else one batch of all free vertices.
PackedDeviceRings pack_rings(Context& context, DeviceRings rings, DeviceBuffer<Point2<double>> points,
                             const SmoothingOptions& options);

}  // namespace trismooth::cuda

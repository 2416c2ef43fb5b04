// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

/// The order in which the sweeps number the vertices ("packed" numbers): free vertices first, batch after batch, each
/// batch along a Hilbert curve; fixed vertices last. The vertices of a batch are updated at the same time. No result
/// depends on the order.
struct VertexOrder {
  DeviceBuffer<std::int32_t> input_index;   ///< the caller's number of each packed vertex
  DeviceBuffer<std::int32_t> batch_begins;  ///< `batches` on the device
  std::vector<std::int32_t> batches{0, 0};  ///< batch b holds packed vertices batches[b] .. batches[b + 1]
  std::int32_t colours = 0;                 ///< 0 where vertices were not coloured

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(input_index.size()); }
  std::int32_t free_count() const { return batches.back(); }
};

/// How vertices are ordered within windows of the curve.
enum class Windows : std::uint8_t {
  none,      ///< along the curve
  by_size,   ///< by ring size
  far_last,  ///< by ring size, and those with a neighbour far away last
};

/// Fills all of `order` but its colours. `rings` and `points` (one for every vertex, local frame) are in input
/// numbering, on the device; the memory of `points` goes back on the way. `colours`: of each vertex its batch, of
/// `batch_count`; null: all free vertices are one batch.
void order_vertices(Context& context, const RingsView& rings, DeviceBuffer<Point2<double>> points,
                    const std::int32_t* colours, std::int32_t batch_count, Windows windows, VertexOrder& order);

}  // namespace trismooth::cuda

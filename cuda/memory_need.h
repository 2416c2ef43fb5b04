// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/cuda/packing/engine_rings.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// An estimate of the device memory in bytes that it takes to pack rings and smooth their vertices; the larger of both
/// peaks. Not in it: the coordinates as they are stored, which are there already or allocated beside it, and the list
/// of what the guard takes back (32 bytes for each vertex of a round).
std::size_t memory_need(const MeshSize& size, const SmoothingOptions& options);

/// Bytes that a DeviceTopology keeps, the caller's triangles apart, and what it takes beside a smoother to orient the
/// mesh by new coordinates.
std::size_t topology_memory_need(std::int64_t vertices, std::int64_t triangles);

/// Throws DeviceError, which says how much is needed and how much is there, where less than `bytes` of the current
/// device's memory can be had.
void require_memory(std::size_t bytes);

}  // namespace trismooth::cuda

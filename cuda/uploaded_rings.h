// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/cuda/runtime/host_copy.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth::cuda {

/// Throws DeviceError where the device has too little memory to smooth a mesh of these rings, stored coordinates among
/// them.
void require_room_for(const OneRings& rings, const SmoothingOptions& options);

/// Throws std::invalid_argument for the executions that smooth triangles alone.
void require_quadrilaterals(const SmoothingOptions& options);

/// One-rings of the host on the device.
DeviceRings uploaded(HostCopier& copier, const OneRings& rings);

}  // namespace trismooth::cuda

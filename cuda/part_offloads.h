// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/smoothing/parts/mesh_part.h"
#include "trismooth/smoothing/sweeps/sweep_offload.h"

namespace trismooth::cuda {

/// Makes the sweeps of a part on a device of this machine: that of the part's place on it, in turn where there are more
/// parts than devices. Throws DeviceError where there is none.
std::unique_ptr<SweepOffloads> part_offloads(const MeshPart& part);

/// Makes the sweeps of any part on the device of that number. Throws DeviceError where there is none.
std::unique_ptr<SweepOffloads> part_offloads_on(int device);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth::cuda {

/// Asks whether the current device can run this build's kernels. Throws DeviceError where it cannot: a device older
/// than those that the build was compiled for gives cudaErrorNoKernelImageForDevice.
void probe_device();

}  // namespace trismooth::cuda

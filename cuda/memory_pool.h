// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime_api.h>

namespace trismooth::cuda {

/// Where the memory of all smoothers on the current device comes from: a pool of our own, made at its first use and
/// kept for as long as the process. CUDA's default pool gives everything back whenever somebody waits for the device,
/// and mapping it anew takes longer than a small mesh; its settings belong to the program that we are part of. This
/// pool keeps what is freed, up to a sixteenth of the device's memory in all; see give_memory_back(). Throws
/// DeviceError.
cudaMemPool_t memory_pool();

/// Returns what the current device's pool keeps without using it to the device, for whoever else needs it. What
/// smoothers and plans use stays. Throws DeviceError.
void give_memory_back();

}  // namespace trismooth::cuda

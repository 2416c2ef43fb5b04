// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace trismooth::cuda {

/// Multiprocessors of the current device. Throws DeviceError.
int multiprocessor_count();

/// The most shared memory in bytes that a block on the current device may ask for. Throws DeviceError.
std::size_t most_shared_bytes();

}  // namespace trismooth::cuda

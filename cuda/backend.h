#pragma once

#include "trismooth/smoothing/backend.h"

namespace trismooth::cuda {

/// The CUDA backend, for SmoothingOptions::backend. It runs on the current device of the calling thread. The topology,
/// renumbered and coloured, stays on the device for as long as what prepare() and prepare_mesh() return. All throw
/// DeviceError, with the CUDA error's name, where there is no device, its memory does not suffice, or a call fails.
/// Options are those of SmoothingOptions; `threads` copy large arrays from and to the host.
const Backend& backend();

}  // namespace trismooth::cuda

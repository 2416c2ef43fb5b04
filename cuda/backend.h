#pragma once

namespace trismooth {
class Backend;
}

namespace trismooth::cuda {

/// The CUDA backend, for SmoothingOptions::backend. It runs on the current device of the calling thread. The topology,
/// renumbered and coloured, stays on the device for as long as a SmoothingPlan, or a call of smooth(), needs it. These
/// throw DeviceError, with the CUDA error's name, where there is no device, its memory does not suffice, or a call
/// fails. Options are those of SmoothingOptions; `threads` copy large arrays from and to the host.
const Backend& backend();

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

namespace trismooth {
class Backend;
}

namespace trismooth::cuda {

/// The CUDA backend, for SmoothingOptions::backend. It runs on the current device of the calling thread. The topology,
/// renumbered and coloured, stays on the device for as long as a SmoothingPlan, or a call of smooth(), needs it. These
/// throw DeviceError, with the CUDA error's name, where there is no device, its memory does not suffice, or a call
/// fails. Options are those of SmoothingOptions; `threads` copy large arrays from and to the host.
const Backend& backend();

/// The backend for devices of this machine, by CUDA's numbers: for one of them what backend() is for the current one.
/// Several share out the sweeps of every mesh, each with a part of it; a device that is named twice has two parts.
/// Coordinates on the borders of parts go from device to device by NCCL, where libnccl.so.2 is found and no device is
/// named twice, else by way of the host. Topology, targets and the guard are the CPU's. Where vertices slide the first
/// device does it alone, and the CPU where inverted triangles are untangled; SmoothingResult::backend_note says so.
/// Calls of several threads take turns. In a mesh in pieces over MPI ranks, each names the one that it is to use. The
/// caller owns the backend; it must outlive the plans that use it. Throws std::invalid_argument for an empty list and
/// for numbers below 0, DeviceError where one of the devices is not there.
std::unique_ptr<Backend> backend_on(std::span<const int> devices);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth {

class Backend;

/// From this many free vertices on, smoothing on a GPU pays for starting CUDA and for the transfers there and back:
/// measured on an H200 beside 16 cores, where a start takes a third of a second (benchmarks/results). With fewer cores
/// it pays earlier.
inline constexpr std::int64_t free_vertices_for_cuda = 1'000'000;

/// What the program's `--backend auto` uses, for SmoothingOptions::backend: CUDA where this build has it, a device can
/// be used and the mesh has free_vertices_for_cuda or more, else the CPU. Where CUDA fails, also in the middle of a
/// smoothing, the CPU does the whole work from the beginning: the bits are the same. SmoothingResult::backend names the
/// one that was taken; where a mesh is large enough for CUDA and the CPU smooths it, SmoothingResult::backend_note says
/// why. run_pipeline() starts CUDA, on the default device, while it reads a large file. It lives as long as the
/// program; several threads may use it at the same time.
const Backend& auto_backend();

}  // namespace trismooth

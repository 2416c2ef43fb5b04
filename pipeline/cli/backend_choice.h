// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "trismooth/base/enum_text.h"
#include "trismooth/pipeline/cuda_or_cpu.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// Which backend the user wants.
enum class BackendChoice : std::uint8_t { automatic, cpu, cuda };

template <>
struct EnumText<BackendChoice> {
  static constexpr std::string_view what = "backend";
  static constexpr std::array<std::pair<BackendChoice, std::string_view>, 3> texts{
      {{BackendChoice::automatic, "auto"}, {BackendChoice::cpu, "cpu"}, {BackendChoice::cuda, "cuda"}}};
};

/// Sets `options.backend` to the one that was chosen and checks that it can do what the options ask for, before
/// anything is read: null for the CPU, `cuda.backend`, or `automatic`, which is to be made from the same `cuda`.
/// Order::unordered leaves `automatic` no choice. Throws DeviceError where CUDA is wanted and cannot be had (not in
/// this build, no device, no CDP), std::invalid_argument for options that only another backend has.
void choose_backend(BackendChoice choice, const CudaSupport& cuda, const CudaOrCpu& automatic,
                    SmoothingOptions& options);

/// The backend for the devices that the user names by their numbers, to which `options.backend` is set: the caller
/// keeps it. Throws as choose_backend() does where it is BackendChoice::cuda, std::invalid_argument for
/// BackendChoice::cpu and where several devices are to do what one alone does.
std::unique_ptr<Backend> choose_devices(std::span<const int> devices, BackendChoice choice, const CudaSupport& cuda,
                                        SmoothingOptions& options);

/// choose_backend() for the ranks of an MPI job: the CPU, unless CUDA is asked for. Whether each has a device is found
/// out by all of them together, when they smooth.
void choose_backend_of_ranks(BackendChoice choice, const CudaSupport& cuda, SmoothingOptions& options);

}  // namespace trismooth

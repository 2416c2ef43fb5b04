// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/backend_choice.h"

#include <stdexcept>
#include <string>
#include <string_view>

#include "trismooth/smoothing/errors.h"

namespace trismooth {

namespace {

constexpr std::string_view backend_option = "--backend cuda";

/// `asked_by`: the option that asks for CUDA.
[[noreturn]] void throw_no_cuda(std::string_view asked_by) {
  throw DeviceError("this build has no CUDA backend; leave out '" + std::string(asked_by) +
                    "' to smooth on the CPU, or build with -DTRISMOOTH_CUDA=ON");
}

void require_cuda(const CudaSupport& cuda, const SmoothingOptions& options, std::string_view asked_by) {
  if (cuda.backend == nullptr) {
    throw_no_cuda(asked_by);
  }
  if (options.execution == Execution::cdp && !cuda.has_cdp) {
    throw DeviceError(
        "this build has no CUDA dynamic parallelism; use '--execution resident' or 'single-block', or build with "
        "-DTRISMOOTH_CDP=ON");
  }
  if (const std::string problem = cuda.problem(); !problem.empty()) {
    const std::string order = options.order == Order::unordered ? " --order colour" : "";
    throw DeviceError("no CUDA device to smooth on: " + problem +
                      (asked_by == backend_option ? "; use '--backend cpu" + order + "'"
                                                  : "; leave out '" + std::string(asked_by) + "'") +
                      ", or see what 'trismooth info' finds");
  }
}

}  // namespace

void choose_backend(BackendChoice choice, const CudaSupport& cuda, const CudaOrCpu& automatic,
                    SmoothingOptions& options) {
  const bool unordered = options.order == Order::unordered;
  if (unordered && choice == BackendChoice::cpu) {
    throw std::invalid_argument("'--order unordered' needs the CUDA backend; the CPU smooths in '--order colour' only");
  }
  if (unordered && choice == BackendChoice::automatic && cuda.backend == nullptr) {
    throw std::invalid_argument(
        "'--order unordered' needs the CUDA backend, which this build does not have; the CPU smooths in '--order "
        "colour' only");
  }
  if (unordered || choice == BackendChoice::cuda) {
    require_cuda(cuda, options, backend_option);
    options.backend = cuda.backend;
  } else if (choice == BackendChoice::automatic && cuda.backend != nullptr) {
    options.backend = &automatic;
  } else {
    options.backend = nullptr;
  }
}

std::unique_ptr<Backend> choose_devices(std::span<const int> devices, BackendChoice choice, const CudaSupport& cuda,
                                        SmoothingOptions& options) {
  if (choice == BackendChoice::cpu) {
    throw std::invalid_argument(
        "'--devices' is for the CUDA backend: leave out '--devices', or leave out '--backend cpu'");
  }
  if (devices.size() > 1 && (options.order == Order::unordered || options.execution != Execution::resident)) {
    throw std::invalid_argument("'--order unordered' and the executions of the paper are for one device");
  }
  require_cuda(cuda, options, choice == BackendChoice::cuda ? backend_option : "--devices");
  std::unique_ptr<Backend> backend = cuda.on_devices(devices);
  options.backend = backend.get();
  return backend;
}

void choose_backend_of_ranks(BackendChoice choice, const CudaSupport& cuda, SmoothingOptions& options) {
  if (choice == BackendChoice::cuda && cuda.backend == nullptr) {
    throw_no_cuda(backend_option);
  }
  options.backend = choice == BackendChoice::cuda ? cuda.backend : nullptr;
  if (options.backend == nullptr && options.order == Order::colour) {
    // The CPU ignores them, over ranks as well.
    options.execution = Execution::resident;
    options.layout = Layout::aos;
  }
}

}  // namespace trismooth

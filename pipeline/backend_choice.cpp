#include "trismooth/pipeline/backend_choice.h"

#include "trismooth/smoothing/errors.h"

namespace trismooth {

void choose_backend(BackendChoice choice, SmoothingOptions& options) {
  if (choice == BackendChoice::cuda) {
    throw DeviceError(
        "this build has no CUDA backend; leave out '--backend cuda' to smooth on the CPU, or build with "
        "-DTRISMOOTH_CUDA=ON");
  }
  if (options.order == Order::unordered) {
    throw std::invalid_argument(
        "'--order unordered' needs the CUDA backend, which this build does not have; the CPU smooths in '--order "
        "colour' only");
  }
  options.backend = nullptr;
}

}  // namespace trismooth

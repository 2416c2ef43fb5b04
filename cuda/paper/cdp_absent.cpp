// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

bool built_with_cdp() {
  return false;
}

template <class Mesh>
void launch_cdp(Method /*method*/, const Mesh& /*mesh*/, const LoopRules& /*rules*/, LoopState* /*state*/,
                SweepSums* /*sums*/, cudaStream_t /*stream*/) {
  throw DeviceError(
      "CUDA: this build has no dynamic parallelism (it was configured with -DTRISMOOTH_CDP=OFF); use '--execution "
      "resident' or 'single-block'");
}

TRISMOOTH_INSTANTIATE_FOR_PAPER(launch_cdp);

}  // namespace trismooth::cuda

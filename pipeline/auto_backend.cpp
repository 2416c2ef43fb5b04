// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/auto_backend.h"

#include "trismooth/pipeline/cuda_or_cpu.h"

namespace trismooth {

const Backend& auto_backend() {
  static const CudaOrCpu backend(cuda_support());
  return backend;
}

}  // namespace trismooth

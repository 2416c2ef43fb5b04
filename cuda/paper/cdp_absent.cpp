#include "trismooth/cuda/paper/cdp.h"
#include "trismooth/smoothing/errors.h"

namespace trismooth::cuda {

bool built_with_cdp() {
  return false;
}

template <class Mesh>
void launch_cdp(const MethodInUse<typename Mesh::Scalar>& /*method*/, const Mesh& /*mesh*/, const LoopRules& /*rules*/,
                LoopState* /*state*/, SweepSums* /*sums*/, cudaStream_t /*stream*/) {
  throw DeviceError(
      "CUDA: this build has no dynamic parallelism (it was configured with -DTRISMOOTH_CDP=OFF); use '--execution "
      "resident' or 'single-block'");
}

template void launch_cdp(const MethodInUse<float>&, const MeshAoS<float>&, const LoopRules&, LoopState*, SweepSums*,
                         cudaStream_t);
template void launch_cdp(const MethodInUse<float>&, const MeshSoA<float>&, const LoopRules&, LoopState*, SweepSums*,
                         cudaStream_t);
template void launch_cdp(const MethodInUse<double>&, const MeshAoS<double>&, const LoopRules&, LoopState*, SweepSums*,
                         cudaStream_t);
template void launch_cdp(const MethodInUse<double>&, const MeshSoA<double>&, const LoopRules&, LoopState*, SweepSums*,
                         cudaStream_t);

}  // namespace trismooth::cuda

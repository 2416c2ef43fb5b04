#include <algorithm>

#include "trismooth/cuda/bounding_box.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/cuda/thread_index.cuh"

namespace trismooth::cuda {

namespace {

/// The extremes as keys that atomics can compare; all zeros to begin with.
struct ExtremeKeys {
  unsigned long long low_x;  ///< falling_key() of the smallest
  unsigned long long low_y;
  unsigned long long high_x;  ///< falling_key() of the smallest negated, which is the largest
  unsigned long long high_y;
};

__device__ void join(double value, unsigned long long* key) {
  unsigned long long own = falling_key(value);
  for (int distance = 16; distance > 0; distance /= 2) {
    const unsigned long long other = __shfl_xor_sync(0xffffffffU, own, distance);
    own = other > own ? other : own;
  }
  if (threadIdx.x % 32 == 0) {
    atomicMax(key, own);
  }
}

__global__ void find_extremes(const Point2<double>* points, std::int64_t count, ExtremeKeys* keys) {
  // Threads without a point of their own take the first.
  Point2<double> low = points[0];
  Point2<double> high = low;
  const std::int64_t stride = static_cast<std::int64_t>(gridDim.x) * blockDim.x;
  for (std::int64_t i = thread_index(); i < count; i += stride) {
    const Point2<double> p = points[i];
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y};
  }
  join(low.x, &keys->low_x);
  join(low.y, &keys->low_y);
  join(-high.x, &keys->high_x);
  join(-high.y, &keys->high_y);
}

}  // namespace

BoundingBox bounding_box(Context& context, const Point2<double>* points, std::int64_t count) {
  constexpr unsigned most_blocks = 1024;
  DeviceBuffer<ExtremeKeys> keys(context, 1);
  keys.fill_bytes(0);
  find_extremes<<<std::min(blocks_for(count), most_blocks), block_size, 0, context.stream()>>>(points, count,
                                                                                               keys.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  ExtremeKeys found{};
  keys.download({&found, 1});
  return {{from_falling_key(found.low_x), from_falling_key(found.low_y)},
          {-from_falling_key(found.high_x), -from_falling_key(found.high_y)}};
}

}  // namespace trismooth::cuda

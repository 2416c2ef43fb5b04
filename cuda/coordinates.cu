#include <limits>

#include "trismooth/cuda/coordinates.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/thread_index.cuh"

namespace trismooth::cuda {

namespace {

constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

__global__ void find_not_finite(const Point2<double>* points, std::int32_t count, std::int32_t* first) {
  const std::int64_t v = thread_index();
  if (v < count) {
    const Point2<double> p = points[v];
    if (!(p.x - p.x == 0 && p.y - p.y == 0)) {
      atomicMin(first, static_cast<std::int32_t>(v));
    }
  }
}

__global__ void enter_all(const Point2<double>* stored, std::int32_t count, LocalFrame frame, Point2<double>* local) {
  const std::int64_t v = thread_index();
  if (v < count) {
    local[v] = frame.enter(stored[v]);
  }
}

__global__ void widen_all(const float* xy, std::int32_t count, Point2<double>* points) {
  const std::int64_t v = thread_index();
  if (v < count) {
    points[v] = {static_cast<double>(xy[2 * v]), static_cast<double>(xy[2 * v + 1])};
  }
}

__global__ void narrow_all(const Point2<double>* points, std::int32_t count, float* xy) {
  const std::int64_t v = thread_index();
  if (v < count) {
    xy[2 * v] = static_cast<float>(points[v].x);
    xy[2 * v + 1] = static_cast<float>(points[v].y);
  }
}

}  // namespace

std::int32_t first_not_finite(Context& context, const Point2<double>* points, std::int32_t count) {
  DeviceBuffer<std::int32_t> first(context, 1);
  std::int32_t found = none;
  first.upload({&found, 1});
  if (count > 0) {
    find_not_finite<<<blocks_for(count), block_size, 0, context.stream()>>>(points, count, first.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
  first.download({&found, 1});
  return found == none ? -1 : found;
}

void enter_frame(Context& context, const Point2<double>* stored, std::int32_t count, const LocalFrame& frame,
                 Point2<double>* local) {
  if (count > 0) {
    enter_all<<<blocks_for(count), block_size, 0, context.stream()>>>(stored, count, frame, local);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

void widen(Context& context, const float* xy, std::int32_t count, Point2<double>* points) {
  if (count > 0) {
    widen_all<<<blocks_for(count), block_size, 0, context.stream()>>>(xy, count, points);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

void narrow(Context& context, const Point2<double>* points, std::int32_t count, float* xy) {
  if (count > 0) {
    narrow_all<<<blocks_for(count), block_size, 0, context.stream()>>>(points, count, xy);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "trismooth/base/hold.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/primitives/falling_key.h"
#include "trismooth/cuda/primitives/largest_key.cuh"
#include "trismooth/cuda/runtime/launch.h"

namespace trismooth::cuda {

namespace {

/// Enough threads to keep the memory busy, few enough blocks to be joined quickly.
constexpr unsigned most_blocks = 528;
constexpr unsigned threads = 512;

/// Takes what the blocks have found, and leaves zeros for the next search.
__device__ Extent take_extent(ExtentKeys* keys) {
  const Point2<double> low{from_falling_key(atomicExch(&keys->low_x, 0)),
                           from_falling_key(atomicExch(&keys->low_y, 0))};
  const Point2<double> high{-from_falling_key(atomicExch(&keys->high_x, 0)),
                            -from_falling_key(atomicExch(&keys->high_y, 0))};
  const unsigned first = atomicExch(&keys->first_not_finite, 0);
  keys->finished_blocks = 0;
  Extent extent;
  extent.first_not_finite = first == 0 ? -1 : static_cast<std::int32_t>(~first);
  if (low.x <= high.x) {
    extent.box = {low, high};
    extent.frame = local_frame(low, high);
  }
  return extent;
}

/// The block that finishes last computes the frame of what all have found: no launch of its own, and nobody waits.
__global__ void __launch_bounds__(threads)
    find_extent(const double2* __restrict__ points, std::uint32_t count, const std::uint8_t* __restrict__ reasons,
                ExtentKeys* keys, Extent* found) {
  __shared__ ExtentKeys block;
  if (threadIdx.x == 0) {
    block = ExtentKeys{};
  }
  __syncthreads();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point2<double> low{infinity, infinity};
  Point2<double> high{-infinity, -infinity};
  unsigned first_not_finite = 0;
#pragma unroll 4
  for (std::uint32_t i = blockIdx.x * threads + threadIdx.x; i < count; i += gridDim.x * threads) {
    const double2 p = points[i];
    if (reasons == nullptr || !hold::is_unused(reasons[i])) {
      low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y};
      high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y};
    }
    if (!(p.x - p.x == 0 && p.y - p.y == 0)) {
      first_not_finite = max(first_not_finite, ~i);
    }
  }
  join_largest(&block.low_x, falling_key(low.x));
  join_largest(&block.low_y, falling_key(low.y));
  join_largest(&block.high_x, falling_key(-high.x));
  join_largest(&block.high_y, falling_key(-high.y));
  if (first_not_finite != 0) {
    atomicMax(&block.first_not_finite, first_not_finite);
  }
  __syncthreads();
  if (threadIdx.x != 0) {
    return;
  }
  atomicMax(&keys->low_x, block.low_x);
  atomicMax(&keys->low_y, block.low_y);
  atomicMax(&keys->high_x, block.high_x);
  atomicMax(&keys->high_y, block.high_y);
  if (block.first_not_finite != 0) {
    atomicMax(&keys->first_not_finite, block.first_not_finite);
  }
  __threadfence();
  if (atomicAdd(&keys->finished_blocks, 1) + 1 == gridDim.x) {
    __threadfence();
    *found = take_extent(keys);
  }
}

}  // namespace

ExtentFinder::ExtentFinder(Context& context) : context_(&context), keys_(context, 1), found_(context, 1) {
  keys_.fill_bytes(0);
  // Gaps between the members are copied to the host with them.
  found_.fill_bytes(0);
}

void ExtentFinder::find(const Point2<double>* points, std::int32_t count, const std::uint8_t* reasons) {
  const unsigned blocks = std::clamp(blocks_for(count, threads), 1U, most_blocks);
  find_extent<<<blocks, threads, 0, context_->stream()>>>(reinterpret_cast<const double2*>(points),
                                                          static_cast<std::uint32_t>(count), reasons, keys_.data(),
                                                          found_.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

Extent ExtentFinder::extent() const {
  return download(*context_, found_.data());
}

BoundingBox bounding_box(Context& context, const Point2<double>* points, std::int32_t count) {
  ExtentFinder finder(context);
  finder.find(points, count);
  return finder.extent().box;
}

}  // namespace trismooth::cuda

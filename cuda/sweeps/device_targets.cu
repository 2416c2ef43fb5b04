#include <algorithm>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/cuda/update/ring_in_memory.cuh"

namespace trismooth::cuda {

namespace {

/// Enough blocks to keep the GPU busy, few enough that their sums do not wait for each other.
constexpr unsigned most_blocks = 1024;

__device__ void add(std::uint64_t& sum, std::uint64_t value) {
  atomicAdd(reinterpret_cast<unsigned long long*>(&sum), static_cast<unsigned long long>(value));
}

/// Adds up over the block. All its threads call it.
__device__ void add_in_block(MeanRatioSums own, MeanRatioSums& block, MeanRatioSums& all) {
  for (int distance = 16; distance > 0; distance /= 2) {
    own.areas += __shfl_xor_sync(0xffffffffU, own.areas, distance);
    own.quotients += __shfl_xor_sync(0xffffffffU, own.quotients, distance);
    own.count += __shfl_xor_sync(0xffffffffU, own.count, distance);
  }
  if (threadIdx.x == 0) {
    block = MeanRatioSums{};
  }
  __syncthreads();
  const auto add_to = [&](MeanRatioSums& sums, const MeanRatioSums& part) {
    add(sums.areas, part.areas);
    add(sums.quotients, part.quotients);
    add(sums.count, part.count);
  };
  if (threadIdx.x % 32 == 0) {
    add_to(block, own);
  }
  __syncthreads();
  if (threadIdx.x == 0) {
    add_to(all, block);
  }
}

/// The first pass: leaves each vertex's mean area in `areas`.
template <class T, class Rings>
__global__ void __launch_bounds__(block_size)
    measure(Rings rings, PointArray<T> points, T* areas, T* shares, MeanRatioSums* sums, FixedVertexArea* fixed) {
  __shared__ MeanRatioSums of_block;
  MeanRatioSums own{};
  for (std::int64_t i = thread_index(); i < rings.size; i += static_cast<std::int64_t>(gridDim.x) * block_size) {
    const auto v = static_cast<std::int32_t>(i);
    const Point2<T> position = points.load(v);
    const auto ring = ring_in_memory(points, rings, v);
    const MeanRatioRing<T> found = measure_for_mean_ratio(position, ring);
    own.add(found.sums);
    areas[v] = found.mean_area;
    shares[v] = found.largest_share;
    for_fixed_corners(position, ring, rings.size, [&](std::int32_t u, double area, std::uint64_t /*times*/) {
      atomicMax(reinterpret_cast<unsigned long long*>(&fixed[u - rings.size].largest),
                static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(area)));
    });
  }
  add_in_block(own, of_block, *sums);
}

/// The second pass: what the free vertices aim at, and the sums around fixed ones.
template <class T, class Rings>
struct FinishFree {
  Rings rings;
  PointArray<T> points;
  const MeanRatioSums* sums;
  MeanRatioOptions options;
  T* areas;
  T* shares;
  MeanRatioScales<T>* scales;
  FixedVertexArea* fixed;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    const MeanRatioMesh mesh = MeanRatioMesh::of(*sums, options.size_weight, options.power);
    for_fixed_corners(points.load(v), ring_in_memory(points, rings, v), rings.size,
                      [&](std::int32_t u, double area, std::uint64_t times) {
                        FixedVertexArea& around = fixed[u - rings.size];
                        add(around.sum, times * static_cast<std::uint64_t>(area * around.units()));
                        add(around.count, times);
                      });
    shares[v] = growth_bound(shares[v], areas[v], mesh);
    areas[v] = inverse_target_area(areas[v], mesh);
    if (v == 0) {
      *scales = {static_cast<T>(mesh.size_weight), mesh.power};
    }
  }
};

/// The last pass, over the fixed vertices; `areas` are theirs.
template <class T>
struct FinishFixed {
  const MeanRatioSums* sums;
  MeanRatioOptions options;
  const FixedVertexArea* fixed;
  T* areas;

  __device__ void operator()(std::uint32_t i) const {
    const MeanRatioMesh mesh = MeanRatioMesh::of(*sums, options.size_weight, options.power);
    areas[i] = inverse_target_area(static_cast<T>(fixed[i].mean()), mesh);
  }
};

}  // namespace

template <class T>
DeviceTargets<T>::DeviceTargets(Context& context, std::int32_t vertex_count, std::int32_t free_count,
                                const SmoothingOptions& options)
    : context_(&context), options_(options.mean_ratio) {
  if (options.method != Method::mean_ratio) {
    return;
  }
  inverse_areas_ = DeviceBuffer<T>(context, static_cast<std::size_t>(vertex_count));
  largest_shares_ = DeviceBuffer<T>(context, static_cast<std::size_t>(free_count));
  scales_ = DeviceBuffer<MeanRatioScales<T>>(context, 1);
  sums_ = DeviceBuffer<MeanRatioSums>(context, 1);
  fixed_ = DeviceBuffer<FixedVertexArea>(context, static_cast<std::size_t>(vertex_count - free_count));
  if (options_.target == TargetShape::input) {
    reference_ = DeviceBuffer<PointRecord<T>>(context, static_cast<std::size_t>(vertex_count));
  }
}

template <class T>
std::size_t DeviceTargets<T>::bytes(std::int64_t vertex_count, std::int64_t free_count,
                                    const SmoothingOptions& options) {
  if (options.method != Method::mean_ratio) {
    return 0;
  }
  const auto vertices = static_cast<std::size_t>(vertex_count);
  const auto free_vertices = static_cast<std::size_t>(free_count);
  const std::size_t reference =
      options.mean_ratio.target == TargetShape::input ? vertices * sizeof(PointRecord<T>) : std::size_t{0};
  return (vertices + free_vertices) * sizeof(T) + (vertices - free_vertices) * sizeof(FixedVertexArea) + reference;
}

template <class T>
template <class Rings>
void DeviceTargets<T>::find(const Rings& rings, const PointArray<T>& points) {
  if (inverse_areas_.size() == 0) {
    return;
  }
  sums_.fill_bytes(0);
  fixed_.fill_bytes(0);
  T* const areas = inverse_areas_.data();
  T* const shares = largest_shares_.data();
  const MeanRatioSums* const sums = sums_.data();
  FixedVertexArea* const fixed = fixed_.data();
  const auto kernel = &measure<T, Rings>;
  kernel<<<std::min(blocks_for(rings.size), most_blocks), block_size, 0, context_->stream()>>>(
      rings, points, areas, shares, sums_.data(), fixed);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  for_each(*context_, static_cast<std::uint32_t>(rings.size),
           FinishFree<T, Rings>{rings, points, sums, options_, areas, shares, scales_.data(), fixed});
  for_each(*context_, static_cast<std::uint32_t>(fixed_.size()),
           FinishFixed<T>{sums, options_, fixed, areas + rings.size});
  if (reference_.size() > 0) {
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(reference_.data(), points.points, reference_.size() * sizeof(PointRecord<T>),
                                         cudaMemcpyDeviceToDevice, context_->stream()));
  }
}

#define INSTANTIATE(T)                                                                               \
  template class DeviceTargets<T>;                                                                   \
  template void DeviceTargets<T>::find(const RingsView&, const PointArray<T>&);                      \
  template void DeviceTargets<T>::find(const SlottedRingsView<std::int16_t>&, const PointArray<T>&); \
  template void DeviceTargets<T>::find(const SlottedRingsView<std::int32_t>&, const PointArray<T>&)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

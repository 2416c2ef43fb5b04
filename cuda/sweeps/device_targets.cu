// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>

#include "trismooth/cuda/packing/ring_views.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/device_targets.h"
#include "trismooth/cuda/update/ring_in_memory.cuh"

namespace trismooth::cuda {

namespace {

/// Enough blocks to keep the GPU busy, few enough that their sums do not wait for each other.
constexpr unsigned most_blocks = 1024;

__device__ void add(std::uint64_t& sum, std::uint64_t value) {
  atomicAdd(reinterpret_cast<unsigned long long*>(&sum), static_cast<unsigned long long>(value));
}

__device__ void add(AreaSum& sum, const AreaSum& more) {
  for (int i = 0; i < AreaSum::part_count; ++i) {
    add(sum.parts[i], more.parts[i]);
  }
}

__device__ void raise(std::uint64_t& largest, std::uint64_t value) {
  atomicMax(reinterpret_cast<unsigned long long*>(&largest), static_cast<unsigned long long>(value));
}

/// What the thread `distance` away has in the warp; all threads of it call it.
__device__ std::uint64_t of_other(std::uint64_t value, int distance) {
  return __shfl_xor_sync(0xffffffffU, value, distance);
}
__device__ AreaSum of_other(const AreaSum& sum, int distance) {
  AreaSum result{};
  for (int i = 0; i < AreaSum::part_count; ++i) {
    result.parts[i] = of_other(sum.parts[i], distance);
  }
  return result;
}

/// Adds up over the block. All its threads call it.
__device__ void add_in_block(MeanRatioSums own, bool has_sizes, MeanRatioSums& block, MeanRatioSums& all) {
  for (int distance = 16; distance > 0; distance /= 2) {
    own.areas.add(of_other(own.areas, distance));
    own.quotients += of_other(own.quotients, distance);
    own.count += of_other(own.count, distance);
    if (has_sizes) {
      own.sizes.add(of_other(own.sizes, distance));
      own.worst_quotient = max(own.worst_quotient, of_other(own.worst_quotient, distance));
    }
  }
  if (threadIdx.x == 0) {
    block = MeanRatioSums{};
  }
  __syncthreads();
  const auto add_to = [&](MeanRatioSums& sums, const MeanRatioSums& part) {
    add(sums.areas, part.areas);
    add(sums.quotients, part.quotients);
    add(sums.count, part.count);
    if (has_sizes) {
      add(sums.sizes, part.sizes);
      raise(sums.worst_quotient, part.worst_quotient);
    }
  };
  if (threadIdx.x % 32 == 0) {
    add_to(block, own);
  }
  __syncthreads();
  if (threadIdx.x == 0) {
    add_to(all, block);
  }
}

/// The first pass: leaves each vertex's mean area in `areas`. `inverse_sizes`: null where no sizes are asked for.
template <class T, class Rings>
__global__ void __launch_bounds__(block_size)
    measure(Rings rings, PointArray<T> points, const T* inverse_sizes, T* areas, T* shares, MeanRatioSums* sums,
            FixedVertexArea* fixed) {
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
    if (inverse_sizes != nullptr) {
      add_sizes(v, position, inverse_sizes, ring, own);
      continue;
    }
    for_fixed_corners(position, ring, rings.size, [&](std::int32_t u, double area, std::uint64_t /*times*/) {
      raise(fixed[u - rings.size].largest, std::bit_cast<std::uint64_t>(area));
    });
  }
  add_in_block(own, inverse_sizes != nullptr, of_block, *sums);
}

/// The second pass: what the free vertices aim at, and the sums around fixed ones.
template <class T, class Rings>
struct FinishFree {
  Rings rings;
  PointArray<T> points;
  const MeanRatioSums* sums;
  double size_weight;
  int power;
  T* areas;
  T* shares;
  MeanRatioScales<T>* scales;
  FixedVertexArea* fixed;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    const MeanRatioMesh mesh = MeanRatioMesh::of(*sums, size_weight, power);
    for_fixed_corners(points.load(v), ring_in_memory(points, rings, v), rings.size,
                      [&](std::int32_t u, double area, std::uint64_t times) {
                        FixedVertexArea& around = fixed[u - rings.size];
                        add(around.sum, times * static_cast<std::uint64_t>(area * around.units()));
                        add(around.count, times);
                      });
    shares[v] = growth_bound(shares[v], areas[v], mesh);
    areas[v] = inverse_target_area(areas[v], mesh);
    if (v == 0) {
      *scales = scales_of<T>(mesh);
    }
  }
};

/// The second pass where sizes are asked for, over all vertices.
template <class T>
struct AimAtSizes {
  std::int32_t free_count;
  const MeanRatioSums* sums;
  double size_weight;
  int power;
  const T* inverse_sizes;
  T* areas;
  T* shares;
  MeanRatioScales<T>* scales;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    const MeanRatioMesh mesh = MeanRatioMesh::of(*sums, size_weight, power, true);
    areas[v] = inverse_asked_area(inverse_sizes[v], mesh);
    if (v < free_count) {
      shares[v] = growth_bound(shares[v], T(1) / areas[v], mesh);
    }
    if (v == 0) {
      *scales = scales_of<T>(mesh);
    }
  }
};

/// The edges around a free vertex, and then their means over its neighbourhood.
template <class T, class Rings>
struct FindEdges {
  Rings rings;
  PointArray<T> points;
  EdgeTensor<T>* around;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    around[v] = edges_around(points.load(v), ring_in_memory(points, rings, v));
  }
};
template <class T, class Rings>
struct AverageEdges {
  Rings rings;
  PointArray<T> points;
  const EdgeTensor<T>* around;
  EdgeTensor<T>* edges;

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    edges[v] = edges_nearby(v, around, ring_in_memory(points, rings, v));
  }
};

/// Targets of a reference where the mesh has moved, of one vertex. `frame`: that of the points.
template <class T, class Rings>
struct MoveTargets {
  Rings rings;
  PointArray<T> points;
  PointArray<T> reference;
  const T* areas_of_reference;
  const T* shares_of_reference;
  const EdgeTensor<T>* edges_of_reference;
  const LocalFrame* frame;
  int exponent;
  T* areas;
  T* shares;
  EdgeTensor<T>* edges;  ///< null where shapes are not to be kept

  __device__ void operator()(std::uint32_t i) const {
    const auto v = static_cast<std::int32_t>(i);
    const int exponents = frame->exponent - exponent;
    areas[v] = inverse_area_in(areas_of_reference[v], exponents);
    if (v >= rings.size) {
      return;
    }
    const Point2<T> position = points.load(v);
    const auto ring = ring_in_memory(points, rings, v);
    const T share = largest_share_in(shares_of_reference[v], exponents);
    const T share_now = measure_for_mean_ratio(position, ring).largest_share;
    shares[v] = share < share_now ? share_now : share;
    if (edges != nullptr) {
      edges[v] = turned(edges_of_reference[v],
                        turn_of_edges(v, position, ring, [this](std::int32_t u) { return reference.load(u); }));
    }
  }
};

/// inverse_sizes[v] = the size of packed vertex v.
template <class T>
struct PackSizes {
  const double* of_input;
  const std::int32_t* input_index;
  T* inverse_sizes;

  __device__ void operator()(std::uint32_t v) const { inverse_sizes[v] = static_cast<T>(of_input[input_index[v]]); }
};

/// The last pass, over the fixed vertices; `areas` are theirs.
template <class T>
struct FinishFixed {
  const MeanRatioSums* sums;
  double size_weight;
  int power;
  const FixedVertexArea* fixed;
  T* areas;

  __device__ void operator()(std::uint32_t i) const {
    const MeanRatioMesh mesh = MeanRatioMesh::of(*sums, size_weight, power);
    areas[i] = inverse_target_area(static_cast<T>(fixed[i].mean()), mesh);
  }
};

}  // namespace

template <class T>
DeviceTargets<T>::DeviceTargets(Context& context, std::int32_t vertex_count, std::int32_t free_count,
                                const SmoothingOptions& options)
    : context_(&context), size_weight_(options.mean_ratio.size_weight), power_(options.mean_ratio.power) {
  if (options.method != Method::mean_ratio) {
    return;
  }
  inverse_areas_ = DeviceBuffer<T>(context, static_cast<std::size_t>(vertex_count));
  largest_shares_ = DeviceBuffer<T>(context, static_cast<std::size_t>(free_count));
  scales_ = DeviceBuffer<MeanRatioScales<T>>(context, 1);
  sums_ = DeviceBuffer<MeanRatioSums>(context, 1);
  if (options.aims_at_sizes()) {
    inverse_sizes_ = DeviceBuffer<T>(context, static_cast<std::size_t>(vertex_count));
  } else {
    fixed_ = DeviceBuffer<FixedVertexArea>(context, static_cast<std::size_t>(vertex_count - free_count));
  }
  if (options.mean_ratio.target == TargetShape::input) {
    around_ = DeviceBuffer<EdgeTensor<T>>(context, static_cast<std::size_t>(vertex_count));
    edges_ = DeviceBuffer<EdgeTensor<T>>(context, static_cast<std::size_t>(vertex_count));
    // Those of fixed vertices stay zeros.
    around_.fill_bytes(0);
    edges_.fill_bytes(0);
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
  const std::size_t edges =
      options.mean_ratio.target == TargetShape::input ? 2 * vertices * sizeof(EdgeTensor<T>) : std::size_t{0};
  // Sizes that are asked for are there as the host has them, too, until they are packed.
  const std::size_t sizes = options.aims_at_sizes() ? vertices * (sizeof(T) + sizeof(double))
                                                    : (vertices - free_vertices) * sizeof(FixedVertexArea);
  return (vertices + free_vertices) * sizeof(T) + sizes + edges;
}

template <class T>
void DeviceTargets<T>::set_sizes(const VertexOrder& order, std::span<const double> inverse_sizes) {
  const DeviceBuffer<double> of_input(*context_, inverse_sizes);
  for_each(*context_, static_cast<std::uint32_t>(inverse_sizes_.size()),
           PackSizes<T>{of_input.data(), order.input_index.data(), inverse_sizes_.data()});
}

template <class T>
template <class Rings>
void DeviceTargets<T>::keep(const Rings& rings, const PointArray<T>& points, int exponent) {
  if (inverse_areas_.size() == 0) {
    return;
  }
  find_anew(rings, points);
  const auto copied = [&]<class Value>(const Value* values, std::size_t count) {
    DeviceBuffer<Value> copy(*context_, count);
    if (count > 0) {
      TRISMOOTH_CUDA_CHECK(
          cudaMemcpyAsync(copy.data(), values, count * sizeof(Value), cudaMemcpyDeviceToDevice, context_->stream()));
    }
    return copy;
  };
  reference_ = Reference{copied(static_cast<const PointRecord<T>*>(points.points), inverse_areas_.size()),
                         copied(static_cast<const T*>(inverse_areas_.data()), inverse_areas_.size()),
                         copied(static_cast<const T*>(largest_shares_.data()), largest_shares_.size()),
                         copied(static_cast<const EdgeTensor<T>*>(edges_.data()), edges_.size()), exponent};
}

template <class T>
template <class Rings>
void DeviceTargets<T>::find(const Rings& rings, const PointArray<T>& points, const LocalFrame* frame) {
  if (inverse_areas_.size() == 0) {
    return;
  }
  if (!reference_) {
    find_anew(rings, points);
    return;
  }
  Reference& of = *reference_;
  for_each(*context_, static_cast<std::uint32_t>(inverse_areas_.size()),
           MoveTargets<T, Rings>{rings, points, PointArray<T>{of.points.data()}, of.inverse_areas.data(),
                                 of.largest_shares.data(), of.edges.data(), frame, of.exponent, inverse_areas_.data(),
                                 largest_shares_.data(), edges_.data()});
}

template <class T>
template <class Rings>
void DeviceTargets<T>::find_anew(const Rings& rings, const PointArray<T>& points) {
  sums_.fill_bytes(0);
  fixed_.fill_bytes(0);
  const T* const sizes = inverse_sizes_.data();
  T* const areas = inverse_areas_.data();
  T* const shares = largest_shares_.data();
  const MeanRatioSums* const sums = sums_.data();
  FixedVertexArea* const fixed = fixed_.data();
  const auto kernel = &measure<T, Rings>;
  kernel<<<std::min(blocks_for(rings.size), most_blocks), block_size, 0, context_->stream()>>>(
      rings, points, sizes, areas, shares, sums_.data(), fixed);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  if (sizes != nullptr) {
    for_each(*context_, static_cast<std::uint32_t>(inverse_sizes_.size()),
             AimAtSizes<T>{rings.size, sums, size_weight_, power_, sizes, areas, shares, scales_.data()});
  } else {
    for_each(*context_, static_cast<std::uint32_t>(rings.size),
             FinishFree<T, Rings>{rings, points, sums, size_weight_, power_, areas, shares, scales_.data(), fixed});
    for_each(*context_, static_cast<std::uint32_t>(fixed_.size()),
             FinishFixed<T>{sums, size_weight_, power_, fixed, areas + rings.size});
  }
  if (edges_.size() > 0) {
    for_each(*context_, static_cast<std::uint32_t>(rings.size), FindEdges<T, Rings>{rings, points, around_.data()});
    for_each(*context_, static_cast<std::uint32_t>(rings.size),
             AverageEdges<T, Rings>{rings, points, around_.data(), edges_.data()});
  }
}

#define INSTANTIATE_FOR(T, Rings)                                                \
  template void DeviceTargets<T>::keep(const Rings&, const PointArray<T>&, int); \
  template void DeviceTargets<T>::find(const Rings&, const PointArray<T>&, const LocalFrame*)
#define INSTANTIATE(T)             \
  template class DeviceTargets<T>; \
  TRISMOOTH_WITH_RING_VIEWS(INSTANTIATE_FOR, T)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

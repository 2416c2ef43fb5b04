// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "trismooth/base/hilbert_curve.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace {

constexpr int curve_order = 16;  // 32 bits of curve under 32 bits of batch
constexpr int curve_bits = 2 * curve_order;
constexpr std::int32_t window_size = 1024;
constexpr int size_bits = 5;

__device__ const detail::HilbertTable hilbert_table_on_device = detail::make_hilbert_table();

/// A grid of 2^curve_order cells along the larger side of the bounding box.
struct CurveGrid {
  Point2<double> low;
  double cells;
};

CurveGrid curve_grid(const BoundingBox& box) {
  const double extent = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return {box.low, extent > 0 ? ((1 << curve_order) - 1) / extent : 0};
}

/// Sorting by these keys puts batches one after another and each along the curve. Without colours all free vertices are
/// in batch 0. Fixed vertices come last.
__global__ void make_keys(RingsView rings, const Point2<double>* points, CurveGrid grid, const std::int32_t* colours,
                          std::int32_t batch_count, std::uint64_t* keys, std::int32_t* vertices,
                          std::uint32_t* batch_sizes) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  std::int32_t batch = batch_count;
  if (rings.ring_size(v) != 0) {
    batch = colours == nullptr ? 0 : colours[v];
  }
  // One atomic for all threads of the warp that have the same batch.
  const unsigned same = __match_any_sync(__activemask(), batch);
  if (threadIdx.x % 32 == static_cast<unsigned>(__ffs(static_cast<int>(same)) - 1)) {
    atomicAdd(&batch_sizes[batch], static_cast<std::uint32_t>(__popc(same)));
  }
  const auto x = static_cast<std::uint32_t>((points[v].x - grid.low.x) * grid.cells);
  const auto y = static_cast<std::uint32_t>((points[v].y - grid.low.y) * grid.cells);
  keys[v] = static_cast<std::uint64_t>(batch) << curve_bits |
            hilbert_index(hilbert_table_on_device.data(), x, y, curve_order);
  vertices[v] = v;
}

/// The place of each free vertex along the curve.
__global__ void find_places(const std::int32_t* order, std::int32_t count, std::int32_t* place) {
  const std::int64_t i = thread_index();
  if (i < count) {
    place[order[i]] = static_cast<std::int32_t>(i);
  }
}

/// Differences that fit a slot of 16 bits, less what vertices may still move apart within their windows.
constexpr std::int32_t near = std::numeric_limits<std::int16_t>::max() - 2 * window_size;

__device__ bool has_far_neighbour(const RingsView& rings, std::int32_t vertex, const std::int32_t* place) {
  const std::int32_t* const ring = rings.ring(vertex);
  bool far = false;
  for (std::int32_t k = 0; k < rings.ring_size(vertex); ++k) {
    const std::int32_t difference = place[ring[k]] - place[vertex];
    far = far || difference > near || difference < -near;
  }
  return far;
}

/// Sorting by these keys puts vertices with rings of like size together within windows of each batch, so that the
/// threads of a warp do the same. Where `place` is given, those with a neighbour far away come last in a window: their
/// rings are in another list. Fixed vertices stay last of all.
__global__ void make_window_keys(RingsView rings, const std::int32_t* order, const std::int32_t* place,
                                 const std::int32_t* batches, std::int32_t batch_count, std::uint64_t* keys) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto own = static_cast<std::int32_t>(i);
  if (own >= batches[batch_count]) {
    keys[own] = ~std::uint64_t{0};
    return;
  }
  std::int32_t batch = 0;  // the last one that begins at or before it
  for (std::int32_t end = batch_count; end - batch > 1;) {
    const std::int32_t middle = batch + (end - batch) / 2;
    (batches[middle] <= own ? batch : end) = middle;
  }
  // Windows are numbered on, one more for each batch: a batch ends with a window that is not full.
  const std::int32_t window = batches[batch] / window_size + batch + (own - batches[batch]) / window_size;
  constexpr std::int32_t last = (1 << size_bits) - 1;
  std::int32_t size = min(rings.ring_size(order[own]), last - 1);
  if (place != nullptr && has_far_neighbour(rings, order[own], place)) {
    size = last;
  }
  keys[own] = static_cast<std::uint64_t>(window) << size_bits | static_cast<std::uint64_t>(size);
}

}  // namespace

void order_vertices(Context& context, const RingsView& rings, DeviceBuffer<Point2<double>> points,
                    const std::int32_t* colours, std::int32_t batch_count, Windows windows, VertexOrder& order) {
  const auto count = static_cast<std::size_t>(rings.size);
  DeviceBuffer<std::uint64_t> keys(context, count);
  DeviceBuffer<std::int32_t> vertices(context, count);
  DeviceBuffer<std::uint32_t> batch_sizes(context, static_cast<std::size_t>(batch_count) + 1);
  batch_sizes.fill_bytes(0);
  make_keys<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(
      rings, points.data(), curve_grid(bounding_box(context, points.data(), rings.size)), colours, batch_count,
      keys.data(), vertices.data(), batch_sizes.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  points.reset();
  const int batch_bits = std::bit_width(static_cast<unsigned>(batch_count));
  sort_by_key(context, keys, vertices, curve_bits + batch_bits);
  std::vector<std::uint32_t> sizes(static_cast<std::size_t>(batch_count) + 1);
  batch_sizes.download(sizes);
  order.batches.assign(1, 0);
  for (std::int32_t batch = 0; batch < batch_count; ++batch) {
    order.batches.push_back(order.batches.back() + static_cast<std::int32_t>(sizes[batch]));
  }
  order.batch_begins = DeviceBuffer<std::int32_t>(context, order.batches);
  if (windows == Windows::none) {
    order.input_index = std::move(vertices);
    return;
  }
  DeviceBuffer<std::int32_t> place(context, windows == Windows::far_last ? count : 0);
  if (windows == Windows::far_last) {
    find_places<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(vertices.data(), rings.size, place.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
  make_window_keys<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(
      rings, vertices.data(), place.data(), order.batch_begins.data(), batch_count, keys.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  place.reset();
  const auto window_count = static_cast<unsigned>(rings.size / window_size + batch_count + 1);
  // One bit more than windows need, for the fixed vertices.
  sort_by_key(context, keys, vertices, size_bits + std::bit_width(window_count) + 1);
  order.input_index = std::move(vertices);
}

}  // namespace trismooth::cuda

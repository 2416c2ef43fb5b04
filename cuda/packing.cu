#include <algorithm>
#include <bit>
#include <utility>

#include "trismooth/cuda/bounding_box.h"
#include "trismooth/cuda/colouring.h"
#include "trismooth/cuda/device_algorithms.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/packing.h"
#include "trismooth/cuda/thread_index.cuh"
#include "trismooth/smoothing/hilbert_curve.h"

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

/// Sorting by these keys puts vertices with rings of like size together within windows of each batch, so that the
/// threads of a warp do the same. Fixed vertices stay last.
__global__ void make_window_keys(RingsView rings, const std::int32_t* order, const std::int32_t* batches,
                                 std::int32_t batch_count, std::uint64_t* keys) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto place = static_cast<std::int32_t>(i);
  if (place >= batches[batch_count]) {
    keys[place] = ~std::uint64_t{0};
    return;
  }
  std::int32_t batch = 0;
  while (place >= batches[batch + 1]) {
    ++batch;
  }
  // Windows are numbered on, one more for each batch: a batch ends with a window that is not full.
  const std::int32_t window = batches[batch] / window_size + batch + (place - batches[batch]) / window_size;
  const std::int32_t size = min(rings.ring_size(order[place]), (1 << size_bits) - 1);
  keys[place] = static_cast<std::uint64_t>(window) << size_bits | static_cast<std::uint64_t>(size);
}

__global__ void number_vertices(const std::int32_t* input_index, std::int32_t vertex_count, std::int32_t free_count,
                                RingsView rings, std::int32_t* new_number, std::uint32_t* ring_sizes) {
  const std::int64_t i = thread_index();
  if (i >= vertex_count) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  new_number[input_index[v]] = v;
  if (v < free_count) {
    ring_sizes[v] = static_cast<std::uint32_t>(rings.ring_size(input_index[v]));
  }
}

__global__ void copy_rings(RingsView from, const std::int32_t* input_index, const std::int32_t* new_number,
                           std::int32_t free_count, const std::uint32_t* offsets, std::int32_t* neighbours) {
  const std::int64_t i = thread_index();
  if (i >= free_count) {
    return;
  }
  const std::int32_t input = input_index[i];
  const std::int32_t* const ring = from.ring(input);
  for (std::int32_t k = 0; k < from.ring_size(input); ++k) {
    neighbours[offsets[i] + static_cast<std::uint32_t>(k)] = new_number[ring[k]];
  }
}

/// Fills input_index, batches and batch_begins.
void order_vertices(Context& context, const RingsView& rings, DeviceBuffer<Point2<double>> points,
                    const DeviceBuffer<std::int32_t>& colours, std::int32_t batch_count, PackedDeviceRings& packed) {
  const auto count = static_cast<std::size_t>(rings.size);
  DeviceBuffer<std::uint64_t> keys(context, count);
  DeviceBuffer<std::int32_t> vertices(context, count);
  DeviceBuffer<std::uint32_t> batch_sizes(context, static_cast<std::size_t>(batch_count) + 1);
  batch_sizes.fill_bytes(0);
  make_keys<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(
      rings, points.data(), curve_grid(bounding_box(context, points.data(), rings.size)), colours.data(), batch_count,
      keys.data(), vertices.data(), batch_sizes.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  points.reset();
  const int batch_bits = std::bit_width(static_cast<unsigned>(batch_count));
  sort_by_key(context, keys, vertices, curve_bits + batch_bits);
  std::vector<std::uint32_t> sizes(static_cast<std::size_t>(batch_count) + 1);
  batch_sizes.download(sizes);
  packed.batches.assign(1, 0);
  for (std::int32_t batch = 0; batch < batch_count; ++batch) {
    packed.batches.push_back(packed.batches.back() + static_cast<std::int32_t>(sizes[batch]));
  }
  packed.batch_begins = DeviceBuffer<std::int32_t>(context, packed.batches);
  make_window_keys<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(
      rings, vertices.data(), packed.batch_begins.data(), batch_count, keys.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  const auto windows = static_cast<unsigned>(rings.size / window_size + batch_count + 1);
  // One bit more than windows need, for the fixed vertices.
  sort_by_key(context, keys, vertices, size_bits + std::bit_width(windows) + 1);
  packed.input_index = std::move(vertices);
}

}  // namespace

PackedDeviceRings pack_rings(Context& context, DeviceRings rings, DeviceBuffer<Point2<double>> points, bool by_colour) {
  PackedDeviceRings packed;
  // A parameter lives as long as the caller's expression; the memory is to go back with this function.
  const DeviceRings source = std::move(rings);
  const RingsView from = source.view();
  if (from.size == 0) {
    packed.batches = {0, 0};
    return packed;
  }
  DeviceColouring colouring;
  if (by_colour) {
    colouring = colour_vertices(context, from);
    packed.colours = colouring.count;
  }
  const std::int32_t batch_count = std::max(1, packed.colours);
  order_vertices(context, from, std::move(points), colouring.colours, batch_count, packed);
  colouring.colours.reset();

  const std::int32_t free_count = packed.free_count();
  DeviceBuffer<std::int32_t> new_number(context, static_cast<std::size_t>(from.size));
  DeviceRings to;
  to.offsets = DeviceBuffer<std::uint32_t>(context, static_cast<std::size_t>(free_count) + 1);
  to.offsets.fill_bytes(0);
  number_vertices<<<blocks_for(from.size), block_size, 0, context.stream()>>>(
      packed.input_index.data(), from.size, free_count, from, new_number.data(), to.offsets.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  sum_before(context, to.offsets.data(), std::int64_t{free_count} + 1);
  to.neighbours = DeviceBuffer<std::int32_t>(context, source.neighbours.size());
  if (free_count > 0) {
    copy_rings<<<blocks_for(free_count), block_size, 0, context.stream()>>>(
        from, packed.input_index.data(), new_number.data(), free_count, to.offsets.data(), to.neighbours.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
  packed.rings = std::move(to);
  return packed;
}

}  // namespace trismooth::cuda

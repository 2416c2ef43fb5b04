// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <type_traits>

#include "trismooth/cuda/packing/renumbering.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"

namespace trismooth::cuda {

namespace {

__global__ void number_vertices(const std::int32_t* input_index, std::int32_t vertex_count, std::int32_t* new_number) {
  const std::int64_t i = thread_index();
  if (i < vertex_count) {
    new_number[input_index[i]] = static_cast<std::int32_t>(i);
  }
}

__global__ void find_ring_sizes(RenumberingView numbers, std::uint32_t* sizes) {
  const std::int64_t i = thread_index();
  if (i < numbers.free_count) {
    sizes[i] = static_cast<std::uint32_t>(numbers.from.ring_size(numbers.input_index[i]));
  }
}

__global__ void copy_rings(RenumberingView numbers, const std::uint32_t* offsets, std::int32_t* neighbours) {
  const std::int64_t i = thread_index();
  if (i >= numbers.free_count) {
    return;
  }
  const std::int32_t input = numbers.input_index[i];
  const std::int32_t* const ring = numbers.from.ring(input);
  for (std::int32_t k = 0; k < numbers.from.ring_size(input); ++k) {
    neighbours[offsets[i] + static_cast<std::uint32_t>(k)] = numbers.new_number[ring[k]];
  }
}

/// Whether a ring is of such a size, and of such elements, that a record may have it.
template <class Slot>
__device__ bool may_be_in_record(const RingsView& rings, std::int32_t input, std::type_identity<Slot> /*slot*/) {
  const std::int32_t size = rings.ring_size(input);
  return size >= RingRecord<Slot>::smallest_ring && size <= RingRecord<Slot>::slots;
}
template <class Slot>
__device__ bool may_be_in_record(const MixedRingsView& rings, std::int32_t input, std::type_identity<Slot> /*slot*/) {
  const auto ring = rings.ring(input);
  bool may = ring.size() == SlottedMixedRing<Slot>::quadrilaterals;
  for (int i = 0; i < SlottedMixedRing<Slot>::quadrilaterals && may; ++i) {
    may = ring.is_quadrilateral(i);
  }
  return may;
}

/// What belongs into slot `k` of a ring that may be in a record: beyond the end of a ring of triangles its first
/// neighbour.
__device__ std::int32_t in_slot(const RingsView& rings, std::int32_t input, std::int32_t k) {
  return rings.ring(input)[k < rings.ring_size(input) ? k : 0];
}
__device__ std::int32_t in_slot(const MixedRingsView& rings, std::int32_t input, std::int32_t k) {
  return rings.ring(input)[k];
}

/// How many numbers the list of long rings has of one of them.
__device__ std::int32_t numbers_in_list(const RingsView& rings, std::int32_t input) {
  return rings.ring_size(input);
}
__device__ std::int32_t numbers_in_list(const MixedRingsView& rings, std::int32_t input) {
  return 2 * rings.ring_size(input);
}

/// Fills the records of all rings that fit one, and how many numbers those have that do not (0 where one does). `from`:
/// the rings that are renumbered.
template <class Slot, class Rings>
__global__ void fill_records(RenumberingView numbers, Rings from, RingRecord<Slot>* records,
                             std::uint32_t* long_sizes) {
  const std::int64_t i = thread_index();
  if (i >= numbers.free_count) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  const std::int32_t input = numbers.input_index[v];
  bool fits = may_be_in_record(from, input, std::type_identity<Slot>{});
  alignas(RingRecord<Slot>) Slot slots[RingRecord<Slot>::slots];
  for (std::int32_t k = 0; k < RingRecord<Slot>::slots && fits; ++k) {
    const std::int32_t other = numbers.new_number[in_slot(from, input, k)];
    const std::int32_t value = sizeof(Slot) == 2 ? other - v : other;
    slots[k] = static_cast<Slot>(value);
    fits = slots[k] == value;
  }
  if (fits) {
    memcpy(&records[v], slots, sizeof(slots));
  }
  long_sizes[v] = fits ? 0 : static_cast<std::uint32_t>(numbers_in_list(from, input));
}

template <class Slot, class Rings>
__global__ void copy_long_rings(RenumberingView numbers, Rings from, const std::uint32_t* begins,
                                RingRecord<Slot>* records, std::int32_t* long_rings) {
  const std::int64_t i = thread_index();
  if (i >= numbers.free_count || begins[i] == begins[i + 1]) {
    return;
  }
  const std::int32_t input = numbers.input_index[i];
  const auto ring = from.ring(input);
  for (std::int32_t k = 0; k < numbers_in_list(from, input); ++k) {
    const std::int32_t other = ring[k];
    long_rings[begins[i] + static_cast<std::uint32_t>(k)] = other == no_corner ? no_corner : numbers.new_number[other];
  }
  records[i] = RingRecord<Slot>::of_long_ring(begins[i], from.ring_size(input));
}

__global__ void copy_colours(RenumberingView numbers, const std::int32_t* colours, std::uint8_t* copied) {
  const std::int64_t i = thread_index();
  if (i < numbers.free_count) {
    copied[i] = static_cast<std::uint8_t>(colours[numbers.input_index[i]]);
  }
}

}  // namespace

Renumbering::Renumbering(Context& context, const RingsView& from, const std::int32_t* input_index,
                         std::int32_t free_count)
    : new_number_(context, static_cast<std::size_t>(from.size)),
      view_{from, input_index, new_number_.data(), free_count} {
  number_vertices<<<blocks_for(from.size), block_size, 0, context.stream()>>>(input_index, from.size,
                                                                              new_number_.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

DeviceRings renumbered(Context& context, const Renumbering& numbers, const DeviceRings& from) {
  const RenumberingView view = numbers.view();
  DeviceRings to;
  to.offsets = DeviceBuffer<std::uint32_t>(context, static_cast<std::size_t>(view.free_count) + 1);
  to.offsets.fill_bytes(0);
  to.neighbours = DeviceBuffer<std::int32_t>(context, from.neighbours.size());
  if (view.free_count > 0) {
    const unsigned blocks = blocks_for(view.free_count);
    find_ring_sizes<<<blocks, block_size, 0, context.stream()>>>(view, to.offsets.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    sum_before(context, to.offsets.data(), std::int64_t{view.free_count} + 1);
    copy_rings<<<blocks, block_size, 0, context.stream()>>>(view, to.offsets.data(), to.neighbours.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
  return to;
}

namespace {

template <class Slot, class Rings>
SlottedRings<Slot> slotted_from(Context& context, const Renumbering& numbers, const Rings& from) {
  const RenumberingView view = numbers.view();
  SlottedRings<Slot> to;
  const auto count = static_cast<std::size_t>(view.free_count);
  if (count == 0) {
    return to;
  }
  to.records = DeviceBuffer<RingRecord<Slot>>(context, count);
  DeviceBuffer<std::uint32_t> begins(context, count + 1);
  begins.fill_bytes(0);
  const unsigned blocks = blocks_for(view.free_count);
  fill_records<<<blocks, block_size, 0, context.stream()>>>(view, from, to.records.data(), begins.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  sum_before(context, begins.data(), std::int64_t{view.free_count} + 1);
  std::uint32_t entries = 0;
  TRISMOOTH_CUDA_CHECK(
      cudaMemcpyAsync(&entries, begins.data() + count, sizeof(entries), cudaMemcpyDeviceToHost, context.stream()));
  context.synchronize();
  // See SlottedRing.
  to.long_rings = DeviceBuffer<std::int32_t>(context, std::size_t{entries} + RingRecord<Slot>::slots);
  to.long_rings.fill_bytes(0);
  copy_long_rings<<<blocks, block_size, 0, context.stream()>>>(view, from, begins.data(), to.records.data(),
                                                               to.long_rings.data());
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  return to;
}

}  // namespace

template <class Slot>
SlottedRings<Slot> slotted(Context& context, const Renumbering& numbers) {
  return slotted_from<Slot>(context, numbers, numbers.view().from);
}
template <class Slot>
SlottedRings<Slot> slotted_mixed(Context& context, const Renumbering& numbers, const std::int32_t* opposites) {
  return slotted_from<Slot>(context, numbers, MixedRingsView{numbers.view().from, opposites});
}

#define INSTANTIATE(Slot)                                            \
  template SlottedRings<Slot> slotted(Context&, const Renumbering&); \
  template SlottedRings<Slot> slotted_mixed(Context&, const Renumbering&, const std::int32_t*)
INSTANTIATE(std::int16_t);
INSTANTIATE(std::int32_t);

DeviceBuffer<std::uint8_t> renumbered(Context& context, const Renumbering& numbers, const std::int32_t* colours) {
  const RenumberingView view = numbers.view();
  DeviceBuffer<std::uint8_t> to(context, colours == nullptr ? 0 : static_cast<std::size_t>(view.free_count));
  if (to.size() > 0) {
    copy_colours<<<blocks_for(view.free_count), block_size, 0, context.stream()>>>(view, colours, to.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  }
  return to;
}

}  // namespace trismooth::cuda

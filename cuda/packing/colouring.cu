// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/splitmix64.h"
#include "trismooth/cuda/packing/colouring.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/smoothing/rings/colouring.h"

namespace trismooth::cuda {

namespace {

constexpr std::int32_t uncoloured = -1;

struct Progress {
  std::uint32_t waiting;  ///< vertices that could not be coloured in the last round
  std::int32_t largest;   ///< colour
};

/// Colours are written by one thread and read by others in the same round; a reader sees the colour or that there is
/// none yet, and both give the same colours in the end.
__device__ std::int32_t current_colour(const std::int32_t* colours, std::int32_t vertex) {
  return *static_cast<const volatile std::int32_t*>(colours + vertex);
}

/// The smallest colour that no other vertex of its elements before the vertex has; uncoloured while one of those has
/// none.
template <class Rings>
__device__ std::int32_t smallest_free_colour(const Rings& rings, std::int32_t v, const std::int32_t* colours) {
  constexpr std::int32_t bits = 64;
  const auto ring = rings.ring(v);
  for (std::int32_t first = 0;; first += bits) {
    std::uint64_t taken = 0;
    // False where it has to wait for that one.
    const auto leave_to = [&](std::int32_t other) {
      if (rings.ring_size(other) != 0 && coloured_before(other, v)) {
        const std::int32_t colour = current_colour(colours, other);
        if (colour == uncoloured) {
          return false;
        }
        if (colour >= first && colour < first + bits) {
          taken |= std::uint64_t{1} << static_cast<unsigned>(colour - first);
        }
      }
      return true;
    };
    for (std::int32_t i = 0; i < rings.ring_size(v); ++i) {
      if (!leave_to(ring[i])) {
        return uncoloured;
      }
      if constexpr (MixedRing<decltype(ring)>) {
        if (ring.is_quadrilateral(i) && !leave_to(ring[ring.size() + i])) {
          return uncoloured;
        }
      }
    }
    if (~taken != 0) {
      return first + __ffsll(static_cast<long long>(~taken)) - 1;
    }
  }
}

template <class Rings>
__global__ void colour_round(Rings rings, std::int32_t* colours, Progress* progress) {
  const std::int64_t i = thread_index();
  if (i >= rings.size) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  if (colours[v] != uncoloured || rings.ring_size(v) == 0) {
    return;
  }
  const std::int32_t colour = smallest_free_colour(rings, v, colours);
  if (colour == uncoloured) {
    atomicAdd(&progress->waiting, 1U);
  } else {
    *static_cast<volatile std::int32_t*>(colours + v) = colour;
    atomicMax(&progress->largest, colour);
  }
}

/// Colours on the host what the rounds have left.
template <class Rings>
void colour_the_rest_on_host(Context& context, const Rings& rings, DeviceColouring& colouring) {
  const auto vertex_count = static_cast<std::size_t>(rings.size);
  const std::vector<std::uint32_t> narrow = download(context, rings.offsets, vertex_count + 1);
  const std::vector<std::int64_t> offsets(narrow.begin(), narrow.end());
  const auto entries = static_cast<std::size_t>(offsets.back());
  const std::vector<std::int32_t> neighbours = download(context, rings.neighbours, entries);
  std::vector<std::int32_t> opposites;
  if constexpr (requires { rings.opposites; }) {
    opposites = download(context, rings.opposites, entries);
  }
  std::vector<std::int32_t> colours = download(context, colouring.colours.data(), vertex_count);
  colour_the_rest({offsets, neighbours, {}, opposites}, colours);
  colouring.colours.upload(colours);
  colouring.count = *std::ranges::max_element(colours) + 1;
}

template <class Rings>
DeviceColouring coloured(Context& context, const Rings& rings) {
  DeviceColouring colouring;
  colouring.colours = DeviceBuffer<std::int32_t>(context, static_cast<std::size_t>(rings.size));
  colouring.colours.fill_bytes(0xff);
  if (rings.size == 0) {
    return colouring;
  }
  DeviceBuffer<Progress> progress(context, 1);
  Progress after{1, uncoloured};
  for (; after.waiting != 0 && colouring.rounds < DeviceColouring::most_rounds; ++colouring.rounds) {
    after.waiting = 0;
    progress.upload({&after, 1});
    colour_round<<<blocks_for(rings.size), block_size, 0, context.stream()>>>(rings, colouring.colours.data(),
                                                                              progress.data());
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    progress.download({&after, 1});
  }
  colouring.count = after.largest + 1;
  if (after.waiting != 0) {
    colour_the_rest_on_host(context, rings, colouring);
  }
  return colouring;
}

}  // namespace

DeviceColouring colour_vertices(Context& context, const RingsView& rings) {
  return coloured(context, rings);
}

DeviceColouring colour_vertices(Context& context, const MixedRingsView& rings) {
  return coloured(context, rings);
}

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <vector>

#include <cub/block/block_scan.cuh>

#include "trismooth/cuda/packing/patch_memory.cuh"
#include "trismooth/cuda/packing/patches.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_properties.h"

namespace trismooth::cuda {

namespace {

constexpr int threads = 1024;
constexpr std::int32_t most_numbers = std::numeric_limits<std::uint16_t>::max();
/// Vertices of a patch that are evaluated, at most.
constexpr std::int32_t list_capacity = 8192;

using Scan = cub::BlockScan<std::int32_t, threads>;

/// What the patches are cut from, and into.
struct Cut {
  RingsView rings;
  std::int32_t vertex_count;
  const std::uint8_t* colours;
  std::int32_t colour_count;
  PatchPlace* places;
  // Null where only the sizes are asked for.
  std::int32_t* vertices;
  std::uint8_t* sweeps;
  std::uint8_t* patch_colours;
  std::uint16_t* ring_begins;
  std::uint16_t* ring_entries;
};

/// A set of vertices of the mesh, a bit each, in shared memory.
struct VertexSet {
  std::uint32_t* words;

  /// True where it was not in the set.
  __device__ bool insert(std::int32_t v) const {
    const std::uint32_t bit = 1U << (v % 32);
    return (atomicOr(&words[v / 32], bit) & bit) == 0;
  }
};

/// What a block needs in shared memory beside the sets.
struct CutWork {
  Scan::TempStorage scan;
  std::int32_t listed;
  std::int32_t list[list_capacity];  ///< the vertices that are evaluated, in the order of their discovery
};

/// Adds to the list those free neighbours of its vertices list[begin .. end) for which depends(v, neighbour) is true.
template <class Depends>
__device__ void grow(const RingsView& rings, const VertexSet& set, std::int32_t begin, std::int32_t end, CutWork& work,
                     const Depends& depends) {
  for (std::int32_t i = begin + static_cast<std::int32_t>(threadIdx.x); i < end; i += threads) {
    const std::int32_t v = work.list[i];
    const std::int32_t* const ring = rings.ring(v);
    for (std::int32_t k = 0; k < rings.ring_size(v); ++k) {
      const std::int32_t neighbour = ring[k];
      if (neighbour < rings.size && depends(v, neighbour) && set.insert(neighbour)) {
        const std::int32_t place = atomicAdd(&work.listed, 1);
        if (place < list_capacity) {
          work.list[place] = neighbour;
        }
      }
    }
  }
  __syncthreads();
}

/// Sum of the values of all threads, for all of them.
__device__ std::int32_t sum_in_block(std::int32_t value, CutWork& work) {
  std::int32_t before = 0;
  std::int32_t total = 0;
  Scan(work.scan).ExclusiveSum(value, before, total);
  __syncthreads();
  return total;
}

__global__ void __launch_bounds__(threads) cut_patch(Cut cut) {
  extern __shared__ std::uint32_t set_words[];
  __shared__ CutWork work;
  const std::int32_t word_count = (cut.vertex_count + 31) / 32;
  const VertexSet set{set_words};
  std::uint32_t* const ranks = set_words + word_count;  // vertices of the patch before each word
  PatchPlace& place = cut.places[blockIdx.x];
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  const auto patch = static_cast<std::int64_t>(blockIdx.x);
  const auto patches = static_cast<std::int64_t>(gridDim.x);
  const auto own_begin = static_cast<std::int32_t>(cut.rings.size * patch / patches);
  const auto own_end = static_cast<std::int32_t>(cut.rings.size * (patch + 1) / patches);
  const std::int32_t own = own_end - own_begin;

  for (std::int32_t w = thread; w < word_count; w += threads) {
    set.words[w] = 0;
  }
  if (thread == 0) {
    work.listed = own;
  }
  __syncthreads();
  if (own > list_capacity) {
    place.vertex_count = most_numbers + 1;
    return;
  }
  for (std::int32_t i = thread; i < own; i += threads) {
    work.list[i] = own_begin + i;
    set.insert(own_begin + i);
  }
  __syncthreads();
  // Layers of the halo: layer_ends[d] vertices of the list are at most d rings away (Form A).
  std::int32_t layer_ends[Patches::sweeps_in_group_a] = {};
  if (cut.colours == nullptr) {
    layer_ends[0] = own;
    for (int d = 1; d < Patches::sweeps_in_group_a; ++d) {
      grow(cut.rings, set, d == 1 ? 0 : layer_ends[d - 2], layer_ends[d - 1], work,
           [](std::int32_t, std::int32_t) { return true; });
      layer_ends[d] = min(work.listed, list_capacity);
      __syncthreads();
    }
  } else {
    for (std::int32_t colour = cut.colour_count - 1; colour > 0; --colour) {
      const std::int32_t listed = min(work.listed, list_capacity);
      __syncthreads();
      grow(cut.rings, set, 0, listed, work, [&](std::int32_t v, std::int32_t neighbour) {
        return cut.colours[v] == colour && cut.colours[neighbour] < colour;
      });
    }
  }
  const std::int32_t evaluated = work.listed;
  if (evaluated > list_capacity) {
    place.vertex_count = most_numbers + 1;
    return;
  }
  // Neighbours that are only looked at.
  std::int32_t entries = 0;
  for (std::int32_t i = thread; i < evaluated; i += threads) {
    const std::int32_t v = work.list[i];
    const std::int32_t* const ring = cut.rings.ring(v);
    const std::int32_t size = cut.rings.ring_size(v);
    entries += size;
    for (std::int32_t k = 0; k < size; ++k) {
      set.insert(ring[k]);
    }
  }
  const std::int32_t entry_count = sum_in_block(entries, work);
  std::int32_t vertex_count = 0;
  for (std::int32_t base = 0; base < word_count; base += threads) {
    const std::int32_t w = base + thread;
    std::int32_t before = 0;
    std::int32_t total = 0;
    Scan(work.scan).ExclusiveSum(w < word_count ? __popc(set.words[w]) : 0, before, total);
    if (w < word_count) {
      ranks[w] = static_cast<std::uint32_t>(vertex_count + before);
    }
    vertex_count += total;
    __syncthreads();
  }
  if (cut.vertices == nullptr) {
    if (thread == 0) {
      place.vertex_count = vertex_count;
      place.entry_count = entry_count;
    }
    return;
  }

  const auto local = [&](std::int32_t v) {
    const std::uint32_t below = (1U << (v % 32)) - 1;
    return static_cast<std::int32_t>(ranks[v / 32]) + __popc(set.words[v / 32] & below);
  };
  const std::size_t first = place.first_vertex;
  std::uint16_t* const begins = cut.ring_begins + first + blockIdx.x;
  if (thread == 0) {
    place.own_begin = own > 0 ? local(own_begin) : 0;
    place.own_end = place.own_begin + own;
  }
  for (std::int32_t w = thread; w < word_count; w += threads) {
    std::uint32_t rest = set.words[w];
    for (std::uint32_t number = ranks[w]; rest != 0; ++number, rest &= rest - 1) {
      const std::int32_t v = w * 32 + __ffs(static_cast<int>(rest)) - 1;
      cut.vertices[first + number] = v;
      cut.sweeps[first + number] = 0;
      cut.patch_colours[first + number] = cut.colours != nullptr && v < cut.rings.size ? cut.colours[v] : 0;
      begins[number] = 0;
    }
  }
  __syncthreads();
  for (std::int32_t i = thread; i < evaluated; i += threads) {
    const std::int32_t v = work.list[i];
    std::int32_t sweeps = Patches::sweeps_in_group_b;
    if (gridDim.x == 1) {
      sweeps = std::numeric_limits<std::uint8_t>::max();
    } else if (cut.colours == nullptr) {
      sweeps = 0;
      for (int d = 0; d < Patches::sweeps_in_group_a; ++d) {
        sweeps += i < layer_ends[d] ? 1 : 0;
      }
    }
    cut.sweeps[first + static_cast<std::size_t>(local(v))] = static_cast<std::uint8_t>(sweeps);
    begins[local(v)] = static_cast<std::uint16_t>(cut.rings.ring_size(v));
  }
  __syncthreads();
  std::int32_t entries_before = 0;
  for (std::int32_t base = 0; base <= vertex_count; base += threads) {
    const std::int32_t number = base + thread;
    std::int32_t before = 0;
    std::int32_t total = 0;
    Scan(work.scan).ExclusiveSum(number < vertex_count ? begins[number] : 0, before, total);
    if (number <= vertex_count) {
      begins[number] = static_cast<std::uint16_t>(entries_before + before);
    }
    entries_before += total;
    __syncthreads();
  }
  for (std::int32_t i = thread; i < evaluated; i += threads) {
    const std::int32_t v = work.list[i];
    const std::int32_t* const ring = cut.rings.ring(v);
    std::uint16_t* const to = cut.ring_entries + place.first_entry + begins[local(v)];
    for (std::int32_t k = 0; k < cut.rings.ring_size(v); ++k) {
      to[k] = static_cast<std::uint16_t>(local(ring[k]));
    }
  }
}

std::size_t set_bytes(std::int32_t vertex_count) {
  return 2 * sizeof(std::uint32_t) * ((static_cast<std::size_t>(vertex_count) + 31) / 32);
}

void launch_cut(const Cut& cut, std::int32_t count, cudaStream_t stream) {
  const std::size_t bytes = set_bytes(cut.vertex_count);
  allow_most_patch_bytes(reinterpret_cast<const void*>(&cut_patch));
  cut_patch<<<static_cast<unsigned>(count), threads, bytes, stream>>>(cut);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

/// A mesh up to this size is one patch: a block that is alone needs no barrier of the grid.
constexpr std::int32_t largest_single = 2048;
/// Above this size sweeps over memory are as fast.
constexpr std::int32_t largest_mesh = 400'000;
/// Vertices that a patch has for itself at least.
constexpr std::int32_t smallest_patch = 64;
constexpr std::int32_t most_colours = 128;
std::int32_t count_of_patches(std::int32_t free_count) {
  if (free_count <= largest_single) {
    return 1;
  }
  return std::min(free_count / smallest_patch, std::int32_t{multiprocessor_count()});
}

}  // namespace

std::size_t most_patch_bytes() {
  // What the kernels have in shared memory of their own.
  constexpr std::size_t others = std::size_t{40} << 10U;
  const std::size_t most = most_shared_bytes();
  return most > others ? most - others : 0;
}

void allow_most_patch_bytes(const void* kernel) {
  TRISMOOTH_CUDA_CHECK(
      cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(most_patch_bytes())));
}

template <class T>
std::size_t patch_bytes(const Patches& patches, const SmoothingOptions& options) {
  return memory_bytes<T>(static_cast<std::size_t>(patches.most_vertices()),
                         static_cast<std::size_t>(patches.most_entries()),
                         {options.form == Form::swap, options.method == Method::mean_ratio});
}
template std::size_t patch_bytes<float>(const Patches&, const SmoothingOptions&);
template std::size_t patch_bytes<double>(const Patches&, const SmoothingOptions&);

bool Patches::may_suit(std::int32_t vertices, std::int32_t colours, const SmoothingOptions& options) {
  // Edge tensors have no room in a patch.
  const bool keeps_shapes = options.method == Method::mean_ratio && options.mean_ratio.target == TargetShape::input;
  return options.execution == Execution::resident && !keeps_shapes && vertices <= largest_mesh &&
         colours <= most_colours && !options.measures_shape() && set_bytes(vertices) <= most_patch_bytes();
}

std::optional<Patches> Patches::cut(Context& context, const RingsView& rings, std::int32_t vertex_count,
                                    const std::uint8_t* colours, std::int32_t colour_count,
                                    const SmoothingOptions& options) {
  if (rings.size == 0) {
    return std::nullopt;
  }
  Patches patches;
  const std::int32_t count = count_of_patches(rings.size);
  std::vector<PatchPlace> places(static_cast<std::size_t>(count));
  patches.count_ = count;
  patches.places_ = DeviceBuffer<PatchPlace>(context, places.size());
  patches.places_.fill_bytes(0);
  Cut cut{};
  cut.rings = rings;
  cut.vertex_count = vertex_count;
  cut.colours = colours;
  cut.colour_count = colour_count;
  cut.places = patches.places_.data();
  launch_cut(cut, count, context.stream());
  patches.places_.download(places);
  std::uint32_t vertices = 0;
  std::uint32_t entries = 0;
  for (PatchPlace& place : places) {
    patches.most_vertices_ = std::max(patches.most_vertices_, place.vertex_count);
    patches.most_entries_ = std::max(patches.most_entries_, place.entry_count);
    place.first_vertex = vertices;
    place.first_entry = entries;
    vertices += static_cast<std::uint32_t>(place.vertex_count);
    entries += static_cast<std::uint32_t>(place.entry_count);
  }
  const std::size_t shared = options.precision == Precision::double_precision ? patch_bytes<double>(patches, options)
                                                                              : patch_bytes<float>(patches, options);
  if (patches.most_vertices_ > most_numbers || patches.most_entries_ > most_numbers || shared > most_patch_bytes()) {
    return std::nullopt;
  }
  patches.places_.upload(places);
  patches.vertices_ = DeviceBuffer<std::int32_t>(context, vertices);
  patches.sweeps_ = DeviceBuffer<std::uint8_t>(context, vertices);
  patches.colours_ = DeviceBuffer<std::uint8_t>(context, vertices);
  patches.ring_begins_ = DeviceBuffer<std::uint16_t>(context, static_cast<std::size_t>(vertices) + places.size());
  patches.ring_entries_ = DeviceBuffer<std::uint16_t>(context, entries);
  cut.vertices = patches.vertices_.data();
  cut.sweeps = patches.sweeps_.data();
  cut.patch_colours = patches.colours_.data();
  cut.ring_begins = patches.ring_begins_.data();
  cut.ring_entries = patches.ring_entries_.data();
  launch_cut(cut, count, context.stream());
  context.synchronize();
  return patches;
}

PatchesView Patches::view() const {
  return {count_,          places_.data(),      vertices_.data(),    sweeps_.data(),
          colours_.data(), ring_begins_.data(), ring_entries_.data()};
}

}  // namespace trismooth::cuda

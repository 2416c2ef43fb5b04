// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/primitives/grid_barrier.cuh"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/sweeps/patches/patch_sweeps.h"
#include "trismooth/cuda/sweeps/patches/patch_visit.cuh"

namespace trismooth::cuda {

namespace {

using patch::in_patch;
using patch::knows_aims;
using patch::PatchRules;
using patch::PatchSums;
using patch::PatchSweep;
using patch::stamp;
using patch::threads_for;
using patch::visit_candidates;

/// Sweeps of a group, at most: those of a single patch.
constexpr std::int32_t longest_group = 16;

struct BlockWork {
  PatchSums sums[longest_group];
  std::uint16_t lists[32][patch::list_size];  ///< of vertices to evaluate, one for each warp
  unsigned long long barrier_total;           ///< of grid_barrier()
  std::int32_t class_begins[256];             ///< colour c: class_list[class_begins[c] .. class_begins[c + 1])
};

/// One sweep of Form A: evaluates the marked vertices that the group's sweep `sweep` is to.
template <class Update, class T>
__device__ void sweep_form_a(const Update& method, std::int32_t sweep, bool all, std::int32_t count,
                             PatchMemory<T>& patch, const PatchRules& rules, BlockWork& work) {
  visit_candidates(count, work.lists[threadIdx.x / 32], PatchSweep<Update, T>{method, patch, rules, work.sums[sweep]},
                   [&](std::int32_t i, std::int32_t& v) {
                     v = i;
                     const bool marked = patch.marked[i] != 0;
                     if (marked) {
                       patch.marked[i] = 0;
                     }
                     return (all || marked) && sweep < patch.sweeps[i];
                   });
  __syncthreads();
  Point2<T>* const old = patch.points;
  patch.points = patch.next_points;
  patch.next_points = old;
  std::uint8_t* const old_marked = patch.marked;
  patch.marked = patch.next_marked;
  patch.next_marked = old_marked;
}

/// One sweep of Form B, colour by colour.
template <class Update, class T>
__device__ void sweep_form_b(const Update& method, std::int32_t sweep, bool all, std::int32_t colours,
                             PatchMemory<T>& patch, const PatchRules& rules, BlockWork& work) {
  for (std::int32_t colour = 0; colour < colours; ++colour) {
    const std::int32_t begin = work.class_begins[colour];
    visit_candidates(work.class_begins[colour + 1] - begin, work.lists[threadIdx.x / 32],
                     PatchSweep<Update, T>{method, patch, rules, work.sums[sweep]},
                     [&](std::int32_t i, std::int32_t& v) {
                       v = patch.list[begin + i];
                       const bool marked = patch.marked[v] != 0;
                       if (marked) {
                         patch.marked[v] = 0;
                       }
                       return all || marked;
                     });
    __syncthreads();
  }
}

/// Lists the vertices that are evaluated by colour.
template <class T>
__device__ void list_classes(std::int32_t count, std::int32_t colours, const PatchMemory<T>& patch, BlockWork& work) {
  constexpr int threads = threads_for<T>;
  for (std::int32_t i = static_cast<std::int32_t>(threadIdx.x); i <= colours + 1; i += threads) {
    work.class_begins[i] = 0;
  }
  __syncthreads();
  // Counts stand two places on, so that filling the list moves begins to where they belong.
  for (std::int32_t v = static_cast<std::int32_t>(threadIdx.x); v < count; v += threads) {
    if (patch.sweeps[v] > 0) {
      atomicAdd(&work.class_begins[patch.colours[v] + 2], 1);
    }
  }
  __syncthreads();
  if (threadIdx.x == 0) {
    for (std::int32_t colour = 0; colour < colours; ++colour) {
      work.class_begins[colour + 2] += work.class_begins[colour + 1];
    }
  }
  __syncthreads();
  for (std::int32_t v = static_cast<std::int32_t>(threadIdx.x); v < count; v += threads) {
    if (patch.sweeps[v] > 0) {
      patch.list[atomicAdd(&work.class_begins[patch.colours[v] + 1], 1)] = static_cast<std::uint16_t>(v);
    }
  }
  __syncthreads();
}

/// Brings in positions and moves from the last group, and marks what they changed.
template <class T>
__device__ void enter_group(const PatchBuffer<T>& from, const std::int32_t* vertices, std::int32_t count,
                            std::int32_t free_count, bool swaps, const PatchMemory<T>& patch, BlockWork& work) {
  constexpr int threads = threads_for<T>;
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  for (std::int32_t v = thread; v < count; v += threads) {
    const std::int32_t number = __ldg(vertices + v);
    const Point2<T> position = from.points.load(number);
    patch.points[v] = position;
    patch.next_points[v] = position;
    patch.moved[v] = number < free_count ? from.moved[number] : 0;
  }
  for (std::int32_t i = thread; i < longest_group; i += threads) {
    work.sums[i] = PatchSums{};
  }
  __syncthreads();
  for (std::int32_t v = thread; v < count; v += threads) {
    bool marked = false;
    if (patch.sweeps[v] > 0) {
      marked = patch.moved[v] != 0;
      for (std::int32_t i = patch.begins[v]; i < patch.begins[v + 1]; ++i) {
        const std::int32_t neighbour = patch.entries[i];
        // One of a lower colour moved before the vertex was looked at.
        marked = marked || (patch.moved[neighbour] != 0 && (swaps || patch.colours[neighbour] > patch.colours[v]));
      }
    }
    patch.marked[v] = marked ? 1 : 0;
    if (swaps) {
      patch.next_marked[v] = 0;
    }
  }
  __syncthreads();
}

/// Brings in what the method aims at around the vertices of the patch.
template <class Update, class T>
__device__ void take_aims(const Update& method, const std::int32_t* vertices, std::int32_t count,
                          std::int32_t free_count, const PatchMemory<T>& patch) {
  if constexpr (knows_aims<Update>) {
    const MeanRatioTargets<T>& aims = method.targets();
    for (std::int32_t v = static_cast<std::int32_t>(threadIdx.x); v < count; v += threads_for<T>) {
      const std::int32_t number = __ldg(vertices + v);
      patch.inverse_areas[v] = aims.inverse_areas[number];
      patch.largest_shares[v] = number < free_count ? aims.largest_shares[number] : T(0);
    }
    if (threadIdx.x == 0) {
      *patch.scales = *aims.scales;
    }
  }
}

/// What the blocks tell each other of a group: bit s: a vertex moved in its sweep s; bit 32 + s: beyond the tolerance.
constexpr unsigned beyond_shift = 32;

__device__ unsigned long long bits_of(const PatchSums& sums, std::int32_t sweep) {
  return (sums.moved > 0 ? 1ULL << static_cast<unsigned>(sweep) : 0ULL) |
         (sums.beyond_tolerance > 0 ? 1ULL << (beyond_shift + static_cast<unsigned>(sweep)) : 0ULL);
}

/// A StopReason after the group's sweep `sweep`, or LoopState::running. `moved`: how many vertices moved in it. It is
/// looked at only where the rules count them: the bits are one word to read for a whole group.
template <class Count>
__device__ std::int32_t stop_in_group(unsigned long long found, std::int32_t sweep, const LoopRules& rules,
                                      const volatile Count& moved) {
  const bool any_moved = (found >> static_cast<unsigned>(sweep) & 1) != 0;
  const bool beyond = (found >> (beyond_shift + static_cast<unsigned>(sweep)) & 1) != 0;
  SweepSums sums{};
  if (any_moved) {
    sums.moved = rules.few_moves > 0 ? static_cast<unsigned long long>(moved) : 1;
  }
  sums.beyond_tolerance = beyond ? 1 : 0;
  return stop_after(sums, rules);
}

template <class Update, class T, bool swaps>
__global__ void __launch_bounds__(threads_for<T>, 1)
    sweep_patches(Update method, PatchedMesh<T> mesh, LoopRules rules, std::int32_t group_length,
                  std::int32_t free_count, LoopState* state, SweepSums* sums, BarrierWord* barriers,
                  unsigned long long* found) {
  constexpr int threads = threads_for<T>;
  extern __shared__ __align__(16) std::uint8_t memory[];
  __shared__ BlockWork work;
  const PatchPlace place = mesh.patches.places[blockIdx.x];
  const std::int32_t count = place.vertex_count;
  const auto thread = static_cast<std::int32_t>(threadIdx.x);
  PatchMemory<T> patch =
      divide_memory<T>(memory, static_cast<std::size_t>(count), static_cast<std::size_t>(place.entry_count),
                       PatchUse{swaps, knows_aims<Update>});
  const std::int32_t* const vertices = mesh.patches.vertices + place.first_vertex;
  for (std::int32_t v = thread; v <= count; v += threads) {
    patch.begins[v] = mesh.patches.ring_begins[place.first_vertex + blockIdx.x + static_cast<std::uint32_t>(v)];
  }
  for (std::int32_t v = thread; v < count; v += threads) {
    patch.sweeps[v] = mesh.patches.sweeps[place.first_vertex + static_cast<std::uint32_t>(v)];
    patch.colours[v] = mesh.patches.colours[place.first_vertex + static_cast<std::uint32_t>(v)];
  }
  for (std::int32_t i = thread; i < place.entry_count; i += threads) {
    patch.entries[i] = mesh.patches.ring_entries[place.first_entry + static_cast<std::uint32_t>(i)];
  }
  take_aims(method, vertices, count, free_count, patch);
  const Update local_method = in_patch(method, patch);
  __syncthreads();
  if (!swaps) {
    list_classes(count, mesh.colours, patch, work);
  }
  PatchRules patch_rules{place.own_begin, place.own_end, rules.tolerance, 0};
  const bool is_alone = gridDim.x == 1;
  PatchBuffer<T> from = mesh.first;
  PatchBuffer<T> to = mesh.second;
  std::int32_t current = state->current;
  if (current != 0) {
    from = mesh.second;
    to = mesh.first;
  }
  std::int32_t sweep = 0;
  std::int32_t stop = LoopState::running;
  while (sweep < rules.sweeps && stop == LoopState::running) {
    const std::int32_t planned = min(group_length, rules.sweeps - sweep);
    std::int32_t made = planned;
    // Where the group turns out to contain the last sweep, it is made again up to there.
    for (bool again = false;; again = true) {
      enter_group(from, vertices, count, free_count, swaps, patch, work);
      for (std::int32_t s = 0; s < made; ++s) {
        patch_rules.stamp = stamp(s);
        if (swaps) {
          sweep_form_a(local_method, s, rules.evaluates_all, count, patch, patch_rules, work);
        } else {
          sweep_form_b(local_method, s, rules.evaluates_all, mesh.colours, patch, patch_rules, work);
        }
        // A block that is alone decides at once.
        if (is_alone) {
          stop = stop_in_group(bits_of(work.sums[s], s), s, rules, work.sums[s].moved);
          made = stop != LoopState::running ? s + 1 : made;
        }
      }
      for (std::int32_t v = place.own_begin + thread; v < place.own_end; v += threads) {
        const std::int32_t number = __ldg(vertices + v);
        to.points.store(number, patch.points[v]);
        to.moved[number] = patch.moved[v] == stamp(made - 1) ? 1 : 0;
      }
      if (again) {
        break;
      }
      if (thread < made) {
        const PatchSums& own = work.sums[thread];
        SweepSums& all = sums[sweep + thread];
        if (own.evaluated > 0) {
          atomicAdd(&all.evaluated, static_cast<unsigned long long>(own.evaluated));
        }
        if (own.moved > 0) {
          atomicAdd(&all.moved, static_cast<unsigned long long>(own.moved));
          atomicMax(&all.max_relative, own.max_relative);
        }
        if (own.beyond_tolerance > 0) {
          atomicAdd(&all.beyond_tolerance, 1ULL);
        }
      }
      if (is_alone) {
        __syncthreads();
        break;
      }
      if (thread == 0) {
        unsigned long long bits = 0;
        for (std::int32_t s = 0; s < made; ++s) {
          bits |= bits_of(work.sums[s], s);
        }
        if (bits != 0) {
          atomicOr(found, bits);
        }
      }
      grid_barrier(barriers, 0, work.barrier_total, [] {});
      const unsigned long long bits = *static_cast<volatile unsigned long long*>(found);
      for (std::int32_t s = 0; s < planned && stop == LoopState::running; ++s) {
        stop = stop_in_group(bits, s, rules, sums[sweep + s].moved);
        made = s + 1;
      }
      ++barriers;
      ++found;
      // After a sweep in which nothing moved, nothing has.
      if (made == planned || stop == static_cast<std::int32_t>(StopReason::fixed_point)) {
        break;
      }
    }
    sweep += made;
    current = 1 - current;
    const PatchBuffer<T> old = from;
    from = to;
    to = old;
  }
  if (blockIdx.x == 0 && thread == 0) {
    state->current = current;
    state->sweeps = sweep;
    state->stop = stop;
  }
}

/// Whether a patch has room for what a method knows of a vertex.
template <class Update>
constexpr bool fits_patches = true;
template <class T, bool is_last>
constexpr bool fits_patches<MeanRatio<T, true, is_last>> = false;

template <class Update, class T, bool swaps>
void launch_with(const Update& method, const PatchedMesh<T>& mesh, const LoopRules& rules, std::size_t shared_bytes,
                 std::int32_t free_count, LoopState* state, SweepSums* sums, BarrierWord* barriers,
                 unsigned long long* found, cudaStream_t stream) {
  const auto* const kernel = reinterpret_cast<const void*>(&sweep_patches<Update, T, swaps>);
  allow_most_patch_bytes(kernel);
  std::int32_t group_length = longest_group;
  if (mesh.patches.count > 1) {
    group_length = swaps ? Patches::sweeps_in_group_a : Patches::sweeps_in_group_b;
  }
  Update method_argument = method;
  PatchedMesh<T> mesh_argument = mesh;
  LoopRules rules_argument = rules;
  void* arguments[] = {&method_argument, &mesh_argument, &rules_argument, &group_length, &free_count,
                       &state,           &sums,          &barriers,       &found};
  TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(kernel, dim3(static_cast<unsigned>(mesh.patches.count)),
                                                   dim3(threads_for<T>), arguments, shared_bytes, stream));
}

}  // namespace

template <class T>
void launch_patch_sweeps(const MethodInUse<T>& method, const PatchedMesh<T>& mesh, const LoopRules& rules,
                         std::size_t shared_bytes, std::int32_t free_count, LoopState* state, SweepSums* sums,
                         unsigned long long* barriers, unsigned long long* found, cudaStream_t stream) {
  visit_method(method, [&]<class Update>(const Update& update) {
    if constexpr (fits_patches<Update>) {
      if (rules.swaps) {
        launch_with<Update, T, true>(update, mesh, rules, shared_bytes, free_count, state, sums, barriers, found,
                                     stream);
      } else {
        launch_with<Update, T, false>(update, mesh, rules, shared_bytes, free_count, state, sums, barriers, found,
                                      stream);
      }
    }
  });
}

#define INSTANTIATE(T)                                                                                              \
  template void launch_patch_sweeps(const MethodInUse<T>&, const PatchedMesh<T>&, const LoopRules&, std::size_t,    \
                                    std::int32_t, LoopState*, SweepSums*, unsigned long long*, unsigned long long*, \
                                    cudaStream_t)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda

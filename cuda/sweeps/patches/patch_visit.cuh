// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "trismooth/cuda/packing/patch_memory.cuh"
#include "trismooth/cuda/primitives/warp_list.cuh"
#include "trismooth/cuda/sweeps/thread_tally.cuh"
#include "trismooth/cuda/update/team_update.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"

/// How the warps of a block evaluate vertices of its patch.
namespace trismooth::cuda::patch {

template <class T>
constexpr int threads_for = sizeof(T) == sizeof(float) ? 768 : 512;
/// Places in a warp's list.
constexpr int list_size = 96;
constexpr unsigned all_lanes = 0xffffffffU;

/// What a block's vertices did in one sweep.
struct PatchSums {
  std::uint32_t evaluated;
  std::uint32_t moved;
  std::uint32_t beyond_tolerance;
  unsigned long long max_relative;  ///< as in SweepSums
};

/// A ring of any size in a patch.
template <class T>
struct RingInPatch {
  const Point2<T>* points;
  const std::uint16_t* ring;
  int count;

  __device__ int size() const { return count; }
  __device__ Point2<T> operator[](int i) const { return points[ring[i]]; }
  __device__ std::int32_t number(int i) const { return ring[i]; }
};

/// What stands for a group's sweep in PatchMemory::moved. 1 is the last sweep of the group before.
__device__ inline std::uint8_t stamp(std::int32_t sweep) {
  return static_cast<std::uint8_t>(sweep + 2);
}

/// Which vertices of the patch are the block's own, how they are counted, and what they are stamped with.
struct PatchRules {
  std::int32_t own_begin;
  std::int32_t own_end;
  double tolerance;
  std::uint8_t stamp;
};

/// What the threads of a block do in a sweep with the patch's vertices.
template <class Update, class T>
struct PatchSweep {
  const Update& method;  ///< for local numbers: see in_patch()
  const PatchMemory<T>& patch;
  PatchRules rules;
  PatchSums& sums;

  __device__ bool is_own(std::int32_t v) const { return v >= rules.own_begin && v < rules.own_end; }
};

/// Counts a move of the block's own vertices.
template <class Update, class T>
__device__ __forceinline__ void count_move(const MoveLength<T>& length, const PatchSweep<Update, T>& sweep) {
  atomicAdd(&sweep.sums.moved, 1U);
  if (!length.is_within(static_cast<T>(sweep.rules.tolerance))) {
    sweep.sums.beyond_tolerance = 1;
  }
  const double longest = std::bit_cast<double>(*static_cast<volatile unsigned long long*>(&sweep.sums.max_relative));
  if (may_be_longer(length, static_cast<T>(longest))) {
    atomicMax(&sweep.sums.max_relative,
              std::bit_cast<unsigned long long>(static_cast<double>(length.relative_squared())));
  }
}

/// Marks a moved vertex; its neighbours are marked by the caller.
template <class Update, class T>
__device__ __forceinline__ void mark_moved(std::int32_t v, const PatchSweep<Update, T>& sweep) {
  sweep.patch.next_marked[v] = 1;
  sweep.patch.moved[v] = sweep.rules.stamp;
}

/// Whether a method knows what MeanRatioTargets says of a vertex.
template <class Update>
inline constexpr bool knows_aims = requires(const Update& method) {
  method.targets();
};

/// A method for the vertices of a patch by their local numbers, as one for those of the mesh.
template <class Update, class T>
__device__ Update in_patch(const Update& method, const PatchMemory<T>& patch) {
  if constexpr (knows_aims<Update>) {
    return Update({patch.inverse_areas, patch.largest_shares, patch.scales, nullptr}, method.step());
  } else {
    return method;
  }
}

/// The update of a vertex by one thread where that is seldom wanted: for rings of any size, by a method with an update
/// in registers.
template <class Update, class T>
__device__ __noinline__ VertexMove<T> update_alone(Point2<T> position, RingInPatch<T> ring) {
  return update_over(Update{}, 0, position, ring);
}

/// Evaluates one vertex a thread. All threads of the warp call it; those that are not `active` do nothing. True for a
/// vertex that is left to visit_by_team().
template <class Update, class T>
__device__ __forceinline__ bool visit_by_thread(std::int32_t v, bool active, const PatchSweep<Update, T>& sweep) {
  const PatchMemory<T>& patch = sweep.patch;
  const std::int32_t begin = active ? patch.begins[v] : 0;
  const int size = active ? patch.begins[v + 1] - begin : 0;
  VertexMove<T> result;
  Point2<T> position;
  if constexpr (has_register_update<Update, T>) {
    constexpr int capacity = largest_register_ring;
    RegisterRing<T, capacity> ring;
    ring.size = size <= capacity ? size : 0;
    ring.longest = __reduce_max_sync(all_lanes, ring.size);
    if (ring.size == 0) {
      return active;
    }
    unrolled<capacity, RegisterRing<T, capacity>::smallest + 1>(ring.longest + 1, [&](auto i) {
      ring.neighbours[i] = patch.points[patch.entries[begin + (i < size ? i() : 0)]];
    });
    position = patch.points[v];
    if (!try_update(sweep.method, position, ring, result)) {
      return true;
    }
  } else {
    if (!active) {
      return false;
    }
    position = patch.points[v];
    result = update_over(sweep.method, v, position, RingInPatch<T>{patch.points, patch.entries + begin, size});
  }
  patch.next_points[v] = result.move.position;
  if (result.move.moved) {
    mark_moved(v, sweep);
    for (int i = 0; i < size; ++i) {
      patch.next_marked[patch.entries[begin + i]] = 1;
    }
    if (sweep.is_own(v)) {
      count_move(length_of_move(position, result.move.position, size, result.squares), sweep);
    }
  }
  return false;
}

/// Evaluates one vertex a team, whose threads call it with the same arguments. All threads of the warp call it.
template <class Update, class T>
__device__ __forceinline__ void visit_by_team(std::int32_t v, bool active, const PatchSweep<Update, T>& sweep) {
  const PatchMemory<T>& patch = sweep.patch;
  const std::int32_t begin = patch.begins[v];
  const int size = active ? patch.begins[v + 1] - begin : 0;
  const Point2<T> position = patch.points[v];
  const VertexMove<T> result = evaluate_by_team<Update>(
      position, size, [&](int i) { return patch.points[patch.entries[begin + i]]; },
      [&] {
        return update_alone<Update, T>(position, {patch.points, patch.entries + begin, size});
      });
  __syncwarp();  // all threads of the team have read the position that is written now
  if (active && team_lane() == 0) {
    patch.next_points[v] = result.move.position;
  }
  if (result.move.moved) {
    for (int i = team_lane(); i < size; i += team_size) {
      patch.next_marked[patch.entries[begin + i]] = 1;
    }
    if (team_lane() == 0) {
      mark_moved(v, sweep);
      if (sweep.is_own(v)) {
        count_move(length_of_move(position, result.move.position, size, result.squares), sweep);
      }
    }
  }
}

/// Evaluates vertices of the warp's list from `begin` on by teams.
template <class Update, class T>
__device__ __forceinline__ void visit_by_teams(const std::uint16_t* list, int begin, int end,
                                               const PatchSweep<Update, T>& sweep) {
  if constexpr (has_register_update<Update, T>) {
    for (; begin < end; begin += teams) {
      const int i = begin + static_cast<int>(threadIdx.x % 32) / team_size;
      visit_by_team(list[i < end ? i : begin], i < end, sweep);
    }
  }
}

/// Evaluates the vertices of the warp's list: 32 at a time by threads while there are more than a few, what is left and
/// what threads have left by teams. All threads of the warp call it.
template <class Update, class T>
__device__ __forceinline__ void visit_list(std::uint16_t* list, int listed, const PatchSweep<Update, T>& sweep) {
  __syncwarp();
  int begin = 0;
  int left_over = 0;
  while (listed - begin > (has_register_update<Update, T> ? few_for_teams : 0)) {
    const int i = begin + static_cast<int>(threadIdx.x % 32);
    const std::int32_t v = i < listed ? list[i] : 0;
    const bool left = visit_by_thread(v, i < listed, sweep);
    __syncwarp();
    // The places before `begin` are free.
    left_over = added_to_list(list, left_over, left, v);
    begin += 32;
  }
  __syncwarp();
  visit_by_teams(list, 0, left_over, sweep);
  visit_by_teams(list, begin, listed, sweep);
  __syncwarp();
}

/// Evaluates those of `count` candidates that wanted(i, v) says of, with v set to the vertex. The candidates of a warp
/// are far apart: what changes is often near to each other.
template <class Update, class T, class Wanted>
__device__ __forceinline__ void visit_candidates(std::int32_t count, std::uint16_t* list,
                                                 const PatchSweep<Update, T>& sweep, const Wanted& wanted) {
  constexpr std::int32_t warps = threads_for<T> / 32;
  const auto warp = static_cast<std::int32_t>(threadIdx.x / 32);
  const auto lane = static_cast<std::int32_t>(threadIdx.x % 32);
  int listed = 0;
  unsigned evaluated = 0;
  // Where an update takes long, few warps that are full are sooner done than many with few vertices each.
  const std::int32_t used = has_register_update<Update, T> ? warps : min(warps, (count + 31) / 32);
  for (std::int32_t base = 0; warp < used && base + warp < count; base += 32 * used) {
    const std::int32_t i = base + lane * used + warp;
    std::int32_t v = 0;
    const bool is_wanted = i < count && wanted(i, v);
    listed = added_to_list(list, listed, is_wanted, v);
    evaluated += __popc(__ballot_sync(all_lanes, is_wanted && sweep.is_own(v)));
    // In one place: the code is long, and two copies of it leave the cache.
    const bool is_last = base + 32 * used + warp >= count;
    if (listed > (is_last ? 0 : list_size - 32)) {
      visit_list(list, listed, sweep);
      listed = 0;
    }
  }
  if (lane == 0 && evaluated > 0) {
    atomicAdd(&sweep.sums.evaluated, evaluated);
  }
}

}  // namespace trismooth::cuda::patch

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/primitives/vertex_marks.cuh"
#include "trismooth/cuda/sweeps/thread_tally.cuh"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/cuda/update/quadrilateral_fan.cuh"
#include "trismooth/cuda/update/register_ring.cuh"
#include "trismooth/cuda/update/ring_in_memory.cuh"
#include "trismooth/cuda/update/team_update.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"

namespace trismooth::cuda {

/// The rings in registers of those that are in records.
template <class T, class Rings>
struct InRegisters;
template <class T, class Slot>
struct InRegisters<T, SlottedRingsView<Slot>> {
  using Type = RegisterRing<T, largest_register_ring>;
};
template <class T, class Slot>
struct InRegisters<T, SlottedMixedRingsView<Slot>> {
  using Type = QuadrilateralFan<T>;
};

/// Whether vertices with such rings are updated in registers, by methods that have an update there. Others read their
/// rings from memory.
template <class Update, class T, class Rings>
inline constexpr bool updates_in_registers = has_register_update<Update, T, typename InRegisters<T, Rings>::Type>;
/// Whether rings that are not for registers are those of one thread, and not of a team: where there are quadrilaterals
/// such rings may be most.
template <class Rings>
inline constexpr bool long_rings_go_alone = MixedRing<decltype(std::declval<Rings>().ring(0))>;

/// What a sweep reads and writes. `Rings`: SlottedRingsView or SlottedMixedRingsView.
template <class T, class Rings>
struct SweepData {
  Rings rings;
  PointArray<T> from;
  PointArray<T> to;      ///< in Form B `from`
  std::uint32_t* marks;  ///< for the next sweep (Form A), or for those to come (Form B)
  T tolerance;
  /// Set where a vertex is elsewhere than `to` had it, that is two sweeps before (Form A). Null: nobody asks.
  std::uint32_t* differs = nullptr;
};

/// Marks a vertex for the next sweep unless it is fixed.
template <class T, class Rings>
__device__ __forceinline__ void mark_if_free(std::int32_t v, const SweepData<T, Rings>& data) {
  if (v < data.rings.size) {
    mark(data.marks, v);
  }
}

/// The record of a vertex, which never changes: read past the cache's coherence, so that it stays there from sweep to
/// sweep.
template <class Rings>
__device__ __forceinline__ auto fetch_record(const Rings& rings, std::int32_t v) {
  std::remove_cvref_t<decltype(*rings.records)> record;
  const auto* const from = reinterpret_cast<const int4*>(&rings.records[v]);
  auto* const to = reinterpret_cast<int4*>(&record);
#pragma unroll
  for (std::size_t i = 0; i < sizeof(record) / sizeof(int4); ++i) {
    to[i] = __ldg(from + i);
  }
  return record;
}

/// The size of the ring with this record.
template <class Slot>
__device__ __forceinline__ int ring_size(const SlottedRingsView<Slot>& /*rings*/, const RingRecord<Slot>& record) {
  return record.ring_size();
}
template <class Slot>
__device__ __forceinline__ int ring_size(const SlottedMixedRingsView<Slot>& /*rings*/, const RingRecord<Slot>& record) {
  return SlottedMixedRing<Slot>::size_of(record);
}

/// Writes where an evaluated vertex is.
template <class T, class Rings>
__device__ __forceinline__ void settle(std::int32_t v, const Move<T>& move, const SweepData<T, Rings>& data) {
  if (data.differs != nullptr && !(data.to.load(v) == move.position)) {
    *data.differs = 1;
  }
  data.to.store(v, move.position);
}

/// The update of a vertex by one thread, its ring read from memory: for rings of any size.
template <class Update, class T, class Rings>
__device__ __noinline__ VertexMove<T> update_from_memory(Update method, std::int32_t v, Point2<T> position,
                                                         PointArray<T> points, Rings rings) {
  if constexpr (updates_in_registers<Update, T, Rings>) {
    // Those left over are few, and not worth code of their own for fans.
    return update_over(method, v, position, ring_in_memory(points, rings, v));
  } else {
    return with_ring_in_memory(points, rings, v,
                               [&](const auto& ring) { return update_over(method, v, position, ring); });
  }
}

/// Writes where an evaluated vertex is, counts its move and marks what it may move.
template <bool marks, class T, class Rings>
__device__ __forceinline__ void settle_and_mark(std::int32_t v, Point2<T> position, int size,
                                                const VertexMove<T>& result, const SweepData<T, Rings>& data,
                                                ThreadTally<T>& tally) {
  settle(v, result.move, data);
  if (result.move.moved) {
    add_move(tally, length_of_move(position, result.move.position, size, result.squares), data.tolerance);
    if constexpr (marks) {
      mark(data.marks, v);
      for_vertices_around(data.rings.ring(v), size, [&](std::int32_t other) { mark_if_free(other, data); });
    }
  }
}

/// Evaluates one vertex a team, whose threads all call it with the same arguments; all threads of the warp call it.
/// Those that are not `active` do nothing. Exact for every ring.
template <bool marks, class Update, class T, class Rings>
__device__ __forceinline__ void visit_by_team(const Update& method, std::int32_t v, bool active,
                                              const SweepData<T, Rings>& data, ThreadTally<T>& tally) {
  const Point2<T> position = data.from.load(v);
  const auto numbers = data.rings.ring(v);
  const int size = active ? data.rings.ring_size(v) : 0;
  const auto alone = [&] { return update_from_memory(method, v, position, data.from, data.rings); };
  VertexMove<T> result;
  if constexpr (MixedRing<decltype(numbers)>) {
    result = evaluate_by_team<Update>(position, size, ring_in_memory(data.from, data.rings, v), alone);
  } else {
    result = evaluate_by_team<Update>(
        position, size, [&](int i) { return data.from.load(numbers[i]); }, alone);
  }
  __syncwarp();  // all threads of the team have read the position that is written now
  if (active && team_lane() == 0) {
    settle(v, result.move, data);
  }
  if (result.move.moved) {
    if (team_lane() == 0) {
      add_move(tally, length_of_move(position, result.move.position, size, result.squares), data.tolerance);
    }
    if constexpr (marks) {
      if (team_lane() == 0) {
        mark(data.marks, v);
      }
      for (int i = team_lane(); i < size; i += team_size) {
        mark_if_free(numbers[i], data);
        if constexpr (MixedRing<decltype(numbers)>) {
          if (numbers.is_quadrilateral(i)) {
            mark_if_free(numbers[size + i], data);
          }
        }
      }
    }
  }
}

/// Evaluates one vertex a thread. All threads of the warp call it; those that are not `active` do nothing. True for a
/// vertex that is left to visit_by_team(). A vertex that is not evaluated is at the same place in both buffers: a move
/// marks the vertex itself for the next sweep. `record`: that of fetch_record().
template <bool marks, class Update, class T, class Rings, class Record>
__device__ __forceinline__ bool visit(const Update& method, std::int32_t v, const Record& record, bool active,
                                      const SweepData<T, Rings>& data, ThreadTally<T>& tally) {
  // Asked for first: it arrives together with the ring.
  const Point2<T> position = active ? data.from.load(v) : Point2<T>{};
  VertexMove<T> result;
  int size = 0;
  if constexpr (updates_in_registers<Update, T, Rings>) {
    typename InRegisters<T, Rings>::Type ring;
    if constexpr (long_rings_go_alone<Rings>) {
      if (!active) {
        return false;
      }
      size = ring_size(data.rings, record);
      if (!fetch_ring(v, record, data.rings.long_rings, data.from, ring)) {
        result = update_over(method, v, position, ring_in_memory(data.from, data.rings, v));
      } else if (!try_update(method, position, ring, result)) {
        return true;
      }
    } else {
      fetch_ring(v, record, active, data.rings.long_rings, data.from, ring);
      size = ring.size;
      if (size == 0) {
        return active;
      }
      if (!try_update(method, position, ring, result)) {
        return true;
      }
    }
  } else {
    if (!active) {
      return false;
    }
    size = ring_size(data.rings, record);
    result = update_from_memory(method, v, position, data.from, data.rings);
  }
  settle_and_mark<marks>(v, position, size, result, data, tally);
  return false;
}

/// Evaluates `count` vertices by the teams of a warp: vertex(i) is the i-th.
template <bool marks, class Update, class T, class Rings, class Vertex>
__device__ __forceinline__ void visit_by_teams(const Update& method, int count, const SweepData<T, Rings>& data,
                                               ThreadTally<T>& tally, const Vertex& vertex) {
  if constexpr (updates_in_registers<Update, T, Rings>) {
    for (int base = 0; base < count; base += teams) {
      const int i = base + static_cast<int>(threadIdx.x % 32) / team_size;
      visit_by_team<marks>(method, vertex(i < count ? i : 0), i < count, data, tally);
    }
  }
}

}  // namespace trismooth::cuda

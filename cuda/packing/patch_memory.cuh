// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"

namespace trismooth::cuda {

/// A patch in shared memory.
template <class T>
struct PatchMemory {
  Point2<T>* points;       ///< before a sweep
  Point2<T>* next_points;  ///< after it; in Form B the same memory
  std::uint16_t* begins;   ///< ring of local vertex v: entries[begins[v] .. begins[v + 1])
  std::uint16_t* entries;
  std::uint16_t* list;   ///< the vertices that are evaluated, colour by colour (Form B)
  std::uint8_t* sweeps;  ///< of Patches
  std::uint8_t* colours;
  std::uint8_t* marked;       ///< the closed neighbourhood changed since the last evaluation
  std::uint8_t* next_marked;  ///< what is marked for the next sweep; in Form B `marked` itself
  std::uint8_t* moved;        ///< in which sweep the vertex moved last: see stamp()
  // Of MeanRatioTargets, where the patches are for that method.
  T* inverse_areas;
  T* largest_shares;
  MeanRatioScales<T>* scales;
};

/// What the parts of a patch are for.
struct PatchUse {
  bool swaps;     ///< Form A
  bool has_aims;  ///< the mean-ratio method
};

/// So that each part of the memory is aligned for every type.
constexpr std::size_t rounded_up(std::size_t bytes) {
  return (bytes + 15) / 16 * 16;
}

/// Bytes of the parts of a patch's memory, one after the other.
template <class T>
constexpr std::size_t memory_bytes(std::size_t vertices, std::size_t entries, PatchUse use) {
  const std::size_t aims = 2 * rounded_up(vertices * sizeof(T)) + rounded_up(sizeof(MeanRatioScales<T>));
  return (use.swaps ? 2 : 1) * rounded_up(vertices * sizeof(Point2<T>)) + 2 * rounded_up((vertices + 1) * 2) +
         rounded_up(entries * 2) + (use.swaps ? 5 : 4) * rounded_up(vertices) + (use.has_aims ? aims : 0);
}

template <class T>
__device__ PatchMemory<T> divide_memory(std::uint8_t* memory, std::size_t vertices, std::size_t entries, PatchUse use) {
  const auto take = [&memory](std::size_t bytes) {
    std::uint8_t* const part = memory;
    memory += rounded_up(bytes);
    return part;
  };
  PatchMemory<T> patch{};
  patch.points = reinterpret_cast<Point2<T>*>(take(vertices * sizeof(Point2<T>)));
  patch.next_points = use.swaps ? reinterpret_cast<Point2<T>*>(take(vertices * sizeof(Point2<T>))) : patch.points;
  patch.begins = reinterpret_cast<std::uint16_t*>(take((vertices + 1) * 2));
  patch.list = reinterpret_cast<std::uint16_t*>(take((vertices + 1) * 2));
  patch.entries = reinterpret_cast<std::uint16_t*>(take(entries * 2));
  patch.sweeps = take(vertices);
  patch.colours = take(vertices);
  patch.marked = take(vertices);
  patch.next_marked = use.swaps ? take(vertices) : patch.marked;
  patch.moved = take(vertices);
  if (use.has_aims) {
    patch.inverse_areas = reinterpret_cast<T*>(take(vertices * sizeof(T)));
    patch.largest_shares = reinterpret_cast<T*>(take(vertices * sizeof(T)));
    patch.scales = reinterpret_cast<MeanRatioScales<T>*>(take(sizeof(MeanRatioScales<T>)));
  }
  return patch;
}

}  // namespace trismooth::cuda

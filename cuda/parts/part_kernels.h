// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/methods/methods.h"

/// The kernels of a part of a mesh, whose sweeps the host leads.
namespace trismooth::cuda {

/// Which vertices of a batch are evaluated.
enum class Visit : std::uint8_t {
  all,              ///< every one
  all_and_mark,     ///< every one, and moves are marked for the sweeps after it
  marked_and_mark,  ///< those that are marked
};

/// A batch at work: vertices begin .. end, in packed numbering. `Rings`: SlottedRingsView or SlottedMixedRingsView, of
/// std::int32_t.
template <class T, class Rings>
struct PartBatch {
  Rings rings;  ///< of the free vertices
  PointArray<T> from;
  PointArray<T> to;           ///< `from` in Form B
  std::uint32_t* marks;       ///< of this sweep
  std::uint32_t* next_marks;  ///< of the next one; `marks` in Form B
  std::int32_t begin;
  std::int32_t end;
  T tolerance;
};

/// Queues the visit of a batch. Adds to `sums`.
template <class T, class Rings>
void launch_part_batch(const MethodInUse<T>& method, const PartBatch<T, Rings>& batch, Visit visit, SweepSums* sums,
                       cudaStream_t stream);

/// Queues the copying of the points of `count` listed vertices, one after the other, to where they are sent from.
template <class T>
void launch_gathering(const PointArray<T>& points, const std::int32_t* vertices, std::int32_t count,
                      PointRecord<T>* out, cudaStream_t stream);

/// Ghosts whose points have come, and who has them as neighbours.
struct ArrivedGhosts {
  const std::int32_t* vertices;
  std::int32_t count;
  const std::uint32_t* offsets;  ///< ghost i of the list has around[offsets[i] .. offsets[i + 1])
  const std::int32_t* around;    ///< free vertices
};

/// Queues the taking over of their points into `to`. Where they are elsewhere than in `from` (which may be `to`), their
/// neighbours are marked; null: nobody is.
template <class T>
void launch_arrival(const PointRecord<T>* in, const ArrivedGhosts& ghosts, const PointArray<T>& from,
                    const PointArray<T>& to, std::uint32_t* marks, cudaStream_t stream);

}  // namespace trismooth::cuda

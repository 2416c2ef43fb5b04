#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/packing.h"
#include "trismooth/cuda/point_arrays.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/quality/local_frame.h"
#include "trismooth/quality/point2.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::cuda {

/// What the commit judges, in packed numbering. All but the rings' owner is on the device. Where a vertex would be
/// stored is computed from its working position whenever it is asked for, which is cheaper than keeping it.
template <class T, Layout layout>
struct CommitInput {
  const PackedDeviceRings* rings;
  const Point2<double>* before;   ///< all vertices as they were stored, in the local frame
  PointArrays<T, layout> first;   ///< all vertices as the sweeps left them, if state->current is 0...
  PointArrays<T, layout> second;  ///< ...and if it is 1
  const LoopState* state;         ///< the run is over where it says so,
  bool is_over;                   ///< or if this is set
  const LocalFrame* frame;
  Storage storage;
};

/// What the kernels of the commit tell each other and the host; all zeros to begin with.
struct CommitState {
  unsigned long long before;  ///< falling_key() of T, the smallest quotient before of the elements of moved vertices
  unsigned long long after;   ///< falling_key() of the smallest quotient of the same elements after
  std::uint32_t spoilt;       ///< not 0: one of them was valid and is not any more, or has a quotient that is no number
  std::uint32_t offending;    ///< vertices found in all rounds
  std::uint32_t listed;       ///< of those, how many are in the lists
  std::uint32_t moved;        ///< vertices written

  /// Whether all elements pass without a second look: where none is spoilt, and the smallest quotient after is not
  /// below T, no quotient after is below T. So offends() holds for none, and no round would take anything back. (A
  /// falling key is the larger, the smaller the number.)
  TRISMOOTH_HOST_DEVICE bool nothing_offends() const { return spoilt == 0 && after <= before; }
};

/// What the commit took back and wrote.
struct CommitOutcome {
  std::int64_t rounds = 0;               ///< that took something back
  std::vector<RevertedVertex> reverted;  ///< ascending by vertex
  std::int64_t moved = 0;                ///< vertices that were written
};

/// Queues the never-worse commit (never_worse.h), unless `guarded` is false; then the writing alone. It may be queued
/// behind sweeps of which nobody knows yet whether they end the run: where they do not, it does nothing. Where nothing
/// offends, which is nearly always so, the vertices that are elsewhere are written to `stored` (input numbering,
/// aligned to 16 bytes) and the others keep their bits; else nothing is written, and finish_commit() does the rest.
/// Returns the number of launches. There are free vertices.
template <class T, Layout layout>
std::int64_t launch_commit(const CommitInput<T, layout>& input, bool guarded, Point2<double>* stored,
                           CommitState* state, cudaStream_t stream);

/// Ends a commit whose `state` has become `found`: the rounds that take offenders back, and the writing, where the
/// launches have left that. The host is asked once a round. Working positions of reverted vertices are put back. Adds
/// to `launches`.
template <class T, Layout layout>
CommitOutcome finish_commit(Context& context, const CommitInput<T, layout>& input, Point2<double>* stored,
                            CommitState* state, const CommitState& found, std::int64_t& launches);

/// Queues the way into the frame: before[v] = frame->enter(stored[input_index[v]]), and in working precision into both
/// `first` and `second` (which may be the same). The frame is on the device.
template <class T, Layout layout>
void launch_enter(const Point2<double>* stored, const std::int32_t* input_index, std::int32_t vertex_count,
                  const LocalFrame* frame, Point2<double>* before, const PointArrays<T, layout>& first,
                  const PointArrays<T, layout>& second, cudaStream_t stream);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/cuda/guard/held_view.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/sweeps/sweep_state.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::cuda {

/// What the guard judges, in packed numbering. All is on the device. Where a vertex would be stored is computed from
/// its working position whenever it is asked for, which is cheaper than keeping it.
template <class T>
struct GuardInput {
  const std::int32_t* input_index;  ///< of all vertices
  const Point2<double>* before;     ///< all vertices as they were stored, in the local frame; aligned to 16 bytes
  PointArray<T> first;              ///< all vertices as the sweeps left them, if state->current is 0...
  PointArray<T> second;             ///< ...and if it is 1
  const LoopState* state;           ///< the run is over where it says so,
  bool is_over;                     ///< or if this is set
  const LocalFrame* frame;
  Storage storage;
  HeldView held{};  ///< vertices without a ring that may be elsewhere
};

/// What the guard knows of the elements of a set of vertices, as keys of which the largest counts: falling_key() of the
/// smallest quotient before and of the smallest worsened_quotient() among those of moved vertices. So some element
/// offends where `worsened` is above the key of T.
struct GuardKeys {
  unsigned long long before;
  unsigned long long worsened;

  /// In place of `before` where vertices have gone back since: above the keys of all numbers.
  static constexpr unsigned long long outdated = ~0ULL;
};

/// What the kernels of the guard tell each other and the host; all zeros to begin with.
struct GuardState {
  GuardKeys all;                      ///< of all elements as the sweeps left them
  unsigned long long thresholds[3];   ///< keys of T, of this round, the last and the next
  unsigned long long last_threshold;  ///< the key of T when rounds ended
  unsigned long long barriers[3];     ///< of the blocks that make rounds
  std::uint32_t listed;               ///< offenders found, those that the list has no room for among them
  std::uint32_t taken_back;           ///< of those, how many went back: the first ones of the list
  std::uint32_t rounds;               ///< that took something back
  std::uint32_t settled;              ///< not 0: the rounds are over, nothing offends any more
  std::uint32_t moved;                ///< vertices written

  /// Whether no element offends from the start: no round would take anything back. (A falling key is the larger, the
  /// smaller the number.)
  TRISMOOTH_HOST_DEVICE bool nothing_offends() const { return all.worsened <= all.before; }
  TRISMOOTH_HOST_DEVICE bool may_write() const { return nothing_offends() || settled != 0; }
};

/// A vertex that went back.
struct Offender {
  std::int32_t vertex;      ///< packed
  std::int32_t input;       ///< the caller's number
  Point2<double> position;  ///< where it would have been stored
};

/// What the guard needs beside its input, made once for a mesh: about a byte for each free vertex.
struct GuardBuffers {
  DeviceBuffer<GuardKeys> keys;       ///< of the elements of each block of free vertices
  DeviceBuffer<std::uint32_t> marks;  ///< a bit for each vertex that may move; all zeros between runs
  DeviceBuffer<Offender> list;

  /// For runs without the guard.
  GuardBuffers() = default;
  /// `movable`: packed vertices below it may move, free or held to lines.
  GuardBuffers(Context& context, std::int32_t free_count, std::int32_t movable);

  /// Offenders that the list has room for at first. More are rare and cost a round trip to the host. A round that has
  /// more by itself makes the list longer for good.
  static constexpr std::int32_t list_size(std::int32_t free_count) {
    constexpr std::int32_t smallest_size = 4096;
    return std::min(free_count, std::max(smallest_size, free_count / 32));
  }
  bool guards() const { return list.size() > 0; }
};

/// What the guard took back, and what was written.
struct DeviceGuardOutcome {
  std::int64_t rounds = 0;               ///< that took something back
  std::vector<std::int32_t> held;        ///< packed numbers of those of HeldView that went back
  std::vector<RevertedVertex> reverted;  ///< ascending by vertex
  std::int64_t moved = 0;                ///< vertices that were written
  double threshold = 0;                  ///< T in the end: GuardOutcome::threshold
};

/// Queues the guard (see never_worse.h) and the writing of the result, or the writing alone if the buffers are those of
/// a run without the guard. This is the fast way of the commit where coordinates are stored as they are swept: all
/// other images are for the host (smoothing/commit.h), which asks for a run without the guard. It may be queued behind
/// sweeps of which nobody knows yet whether they end the run: where they do not, it does nothing. Else offenders go
/// back, round by round, in their working positions too; then the vertices that are elsewhere are written to `stored`
/// (input numbering, aligned to 16 bytes), and the others keep their bits. Only where there are more offenders than the
/// list holds, nothing is written, and finish_guard() does the rest. Returns the number of launches. `rings`: those of
/// the free vertices, of which there is one at least; a RingsView, SlottedRingsView or SlottedMixedRingsView. Vertices
/// of GuardInput::held are judged as corners of the elements of free ones and go back with these; they are in no figure
/// and are not written. Where there are such nothing is written either, unless nobody had to go back, as
/// HeldView::lines says, too: what becomes of lines is to be seen to first.
template <class T, class Rings>
std::int64_t launch_guard(const Rings& rings, const GuardInput<T>& input, GuardBuffers& buffers, Point2<double>* stored,
                          GuardState* state, cudaStream_t stream);

/// Queues the writing of the free vertices that are elsewhere, whatever a guard has said. Adds to state->moved.
template <class T, class Rings>
void launch_writing(const Rings& rings, const GuardInput<T>& input, Point2<double>* stored, GuardState* state,
                    cudaStream_t stream);

/// Brings over what a guard did whose `state` has become `found`. Where the list was too short, does what is left: the
/// host is asked each time that the list is full. Adds to `launches`.
template <class T, class Rings>
DeviceGuardOutcome finish_guard(Context& context, const Rings& rings, const GuardInput<T>& input, GuardBuffers& buffers,
                                Point2<double>* stored, GuardState* state, GuardState found, std::int64_t& launches);

}  // namespace trismooth::cuda

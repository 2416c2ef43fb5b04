// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/sweeps/ring_lanes.h"

namespace trismooth {

/// Fills in what a method says of the first `count` lanes, whose rings have `ring_size` neighbours and are of that
/// kind.
template <class T>
using LaneUpdate = void (*)(int ring_size, RingKind kind, int count, RingLanes<T>& rings);

/// That of a method by these instructions: the bits of its update(). Null for a method without lanes: see UpdateByRing.
template <class T>
LaneUpdate<T> lane_update(Method method, InstructionSet instructions);

}  // namespace trismooth

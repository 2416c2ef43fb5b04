#pragma once

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/smoothing/sweeps/ring_lanes.h"

namespace trismooth {

/// Fills in what a method says of the first `count` lanes, whose rings have `ring_size` neighbours.
template <class T>
using LaneUpdate = void (*)(int ring_size, int count, RingLanes<T>& rings);

/// That of a method, SmartLaplacian, Laplacian or WeightedLaplacian, by these instructions: the bits of its update().
template <class Update, class T>
LaneUpdate<T> lane_update(InstructionSet instructions);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mpi/communicator.h"
#include "trismooth/smoothing/follow_result.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::mpi {

/// Gives all ranks what rank 0 did, but for lists of its vertices and triangles (`reverted`, UntanglingResult::turned),
/// and for what is each rank's own: processor, threads, launches, timings. Collective.
void share_result(SmoothingResult& result, const Communicator& communicator);

/// Gives all ranks what rank 0 says of a mesh that follows its boundary, its lists among it; of the smoothing as above.
/// Collective.
void share_result(FollowResult& result, const Communicator& communicator);

}  // namespace trismooth::mpi

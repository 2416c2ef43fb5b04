// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mpi/communicator.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::mpi {

/// Gives all ranks what rank 0 did, but for lists of its vertices and triangles (`reverted`, UntanglingResult::turned),
/// and for what is each rank's own: processor, threads, timings. Collective.
void share_result(SmoothingResult& result, const Communicator& communicator);

}  // namespace trismooth::mpi

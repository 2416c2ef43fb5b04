// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <sstream>
#include <string>

#include "trismooth/pipeline/partition.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// The MPI job that this process is a rank of. Made once in a process; its destructor, which waits for all ranks,
/// finishes MPI.
class RankJob {
 public:
  RankJob() = default;
  RankJob(const RankJob&) = delete;
  RankJob& operator=(const RankJob&) = delete;
  virtual ~RankJob() = default;

  virtual int rank() const = 0;
  /// Whether run() shares the work out, and is not run_pipeline().
  virtual bool shares_work() const = 0;

  /// run_pipeline() by all ranks, of a file or of a mesh in pieces. The other ranks call it as rank 0 does, which may
  /// think better of it: they return when it has called it, or agreed(). They get no result, and nothing is thrown
  /// there. An error of one rank alone that the others cannot be told of ends all of them, with its message and its
  /// exit code.
  virtual PipelineResult run(const PipelineOptions& options) = 0;

  /// All ranks, when they have done their work: the exit code of rank 0. A launcher may tell ranks to end from now on,
  /// as others have done. `unread`: what the rank has said to nobody; it is said, and all ranks end, where it has not
  /// come to run() as rank 0 has.
  virtual int agreed(int code, const std::ostringstream& unread) = 0;
};

/// Joins the MPI job that a launcher (mpirun, srun) has made this process a rank of. A process without a launcher is a
/// job by itself where an argument names a mesh in pieces. Null for others, and where the build has no MPI.
std::unique_ptr<RankJob> join_ranks(int argc, const char* const* argv);

/// What stands in front of errors of a process that has not joined its job yet: "rank 3: ", by what launchers tell.
/// Empty for rank 0, and where there is no launcher.
std::string launched_rank();

/// Throws std::invalid_argument where the build cannot share a mesh out in that way.
void require_partition(Partition partition);

/// What of MPI the build has, for people.
std::string mpi_text();

}  // namespace trismooth

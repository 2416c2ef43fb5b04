#pragma once

#include <memory>
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
  /// there.
  virtual PipelineResult run(const PipelineOptions& options) = 0;

  /// All ranks, when they have done their work: the exit code of rank 0. A launcher may tell ranks to end from now on,
  /// as others have done.
  virtual int agreed(int code) = 0;
};

/// Joins the MPI job that a launcher (mpirun, srun) has made this process a rank of. A process without a launcher is a
/// job by itself where an argument names a mesh in pieces. Null for others, and where the build has no MPI.
std::unique_ptr<RankJob> join_ranks(int argc, const char* const* argv);

/// Throws std::invalid_argument where the build cannot share a mesh out in that way.
void require_partition(Partition partition);

/// What of MPI the build has, for people.
std::string mpi_text();

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/rank_run.h"

#include <exception>

#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/pipeline/ranks/piece_options.h"
#include "trismooth/pipeline/ranks/piece_run.h"
#include "trismooth/pipeline/ranks/run_on_first.h"

namespace trismooth {

namespace {

bool is_cancelled(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Cancelled&) {
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

PipelineResult run_over_ranks(const PipelineOptions& options, const std::shared_ptr<const mpi::Communicator>& ranks) {
  require_same_options(options, *ranks);
  const auto& output = options.written();
  if (names_parallel_file(options.input) || (output && names_parallel_file(*output))) {
    return run_pieces(options, ranks);
  }
  if (!output && ranks->size() > 1 && what_needs_whole_mesh(options).empty()) {
    try {
      return run_by_ranges(options, ranks);
    } catch (const mpi::KnownToAll& known) {
      // It is a file for one rank, or wrong in a way that reading it as a whole tells.
      if (is_cancelled(known.error)) {
        throw;
      }
    }
  }
  return run_on_first(options, ranks, &run_pipeline);
}

}  // namespace trismooth

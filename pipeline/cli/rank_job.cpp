// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/rank_job.h"

// The one place that knows whether the build has MPI.
#ifdef TRISMOOTH_HAS_MPI
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <span>
#include <string_view>

#include <mpi.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/pipeline/cli/exit_code.h"
#include "trismooth/pipeline/cli/failure.h"
#include "trismooth/pipeline/cli/messages.h"
#include "trismooth/pipeline/ranks/partition/metis_parts.h"
#include "trismooth/pipeline/ranks/rank_run.h"
#endif

#include <stdexcept>

namespace trismooth {

#ifdef TRISMOOTH_HAS_MPI

namespace {

/// The MPI that the program is linked with, by name and version.
std::string mpi_library() {
  std::string library(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
  int length = 0;
  MPI_Get_library_version(library.data(), &length);
  library.resize(static_cast<std::size_t>(length));
  // (Some say more than which one they are.)
  return library.substr(0, library.find_first_of(",\n"));
}

/// Throws std::invalid_argument where a launcher has started several processes and MPI knows of this one alone: each
/// would do all the work and write the same files.
void require_own_launcher(int ranks) {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* const started = std::getenv(name);
    if (ranks == 1 && started != nullptr && std::strtol(started, nullptr, 10) > 1) {
      throw std::invalid_argument(std::string("the launcher has started ") + started +
                                  " processes, and MPI sees this one alone: it is not the launcher of " +
                                  mpi_library() + ", which the program is linked with");
    }
  }
}

/// By what the launchers of Open MPI, MPICH, Intel MPI and Slurm tell the processes that they start.
bool has_launcher() {
  constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK"};
  return std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; });
}

/// Has arrays of a rank go back to the system when they are freed. By and by the C library raises the size from which
/// on it asks the system for memory of its own, up to 32 MiB, and what is smaller stays with the process, in pieces;
/// ranks share a machine, and have the arrays of a mesh in parts.
void give_back_arrays() {
#ifdef __GLIBC__
  constexpr int bytes = 1 << 22;
  mallopt(M_MMAP_THRESHOLD, bytes);
#endif
}

/// Of one that has no memory to make a message with.
int say_rank_failure_without_memory(int rank) {
  std::fprintf(stderr, "trismooth: error: rank %d: not enough memory\n", rank);
  return static_cast<int>(ExitCode::bad_input);
}

/// Of a rank that has failed where it cannot tell the others: what the program says of errors, and their exit code.
int say_rank_failure(int rank) {
  try {
    std::ostringstream said;
    const ExitCode code = report_failure(said, "rank " + std::to_string(rank) + ": ");
    if (said) {  // else it has swallowed that it has no memory
      std::cerr << said.view() << std::flush;
      return static_cast<int>(code);
    }
  } catch (const std::exception&) {
    // What it was about has been lost with the memory for the message.
  }
  return say_rank_failure_without_memory(rank);
}

volatile std::sig_atomic_t code_at_end = 0;

extern "C" void end_in_spite_of_mpi(int /*signal*/) {
  constexpr std::string_view note = "trismooth: note: MPI crashed while it ended; the work was over before\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, note.data(), note.size());
  ::_exit(code_at_end);
}

/// Ends MPI when all is done, written and said: what crashes in it from then on does not change the exit code. (Once in
/// some thousand times a thread of Open MPI 4.1 is still at work in what it has just taken down: open-mpi/ompi#10117.)
void finish_mpi(int code) {
  code_at_end = code;
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT}) {
    std::signal(crash, &end_in_spite_of_mpi);
  }
  MPI_Finalize();
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT}) {
    std::signal(crash, SIG_DFL);
  }
}

class MpiJob final : public RankJob {
 public:
  explicit MpiJob(bool has_pieces) : has_pieces_(has_pieces) {
    give_back_arrays();
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    try {
      // MPI begins without the memory that it needs to reach the others, and waits for them for ever.
      constexpr std::size_t room_for_mpi = std::size_t{8} << 20;
      require_host_memory(room_for_mpi);
      ranks_ = std::make_shared<const mpi::Communicator>(MPI_COMM_WORLD, &say_rank_failure);
    } catch (...) {
      int rank = 0;
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      mpi::end_all(MPI_COMM_WORLD, say_rank_failure(rank));
    }
  }

  ~MpiJob() override {
    if (std::uncaught_exceptions() > 0) {
      // The others do not know of it: they would never finish.
      mpi::end_all(MPI_COMM_WORLD, say_rank_failure_without_memory(ranks_->rank()));
    }
    ranks_.reset();
    finish_mpi(code_);
  }

  int rank() const override { return ranks_->rank(); }
  bool shares_work() const override { return has_pieces_ || ranks_->size() > 1; }

  PipelineResult run(const PipelineOptions& options) override {
    require_own_launcher(ranks_->size());
    if (!starts(true)) {
      return {};
    }
    try {
      return ranks_->together([&] { return run_over_ranks(options, ranks_); });
    } catch (const std::exception&) {
      if (rank() == 0) {
        throw;
      }
      return {};
    }
  }

  int agreed(int code, const std::ostringstream& unread) override {
    if (!is_settled_ && starts(false)) {
      // Rank 0 has begun what this one cannot take part in.
      if (code == static_cast<int>(ExitCode::done)) {
        print_error(std::cerr, "rank " + std::to_string(rank()) + ": has another command than rank 0");
        code = static_cast<int>(ExitCode::wrong_usage);
      } else if (unread.good() && !unread.view().empty()) {
        std::cerr << unread.view() << std::flush;
      } else {
        say_rank_failure_without_memory(rank());
      }
      mpi::end_all(MPI_COMM_WORLD, code);
    }
    MPI_Bcast(&code, 1, MPI_INT, 0, ranks_->handle());
    code_ = code;
    return code;
  }

 private:
  /// What rank 0 says of whether there is a run.
  bool starts(bool own) {
    int starts = own ? 1 : 0;
    MPI_Bcast(&starts, 1, MPI_INT, 0, ranks_->handle());
    is_settled_ = true;
    return starts != 0;
  }

  bool has_pieces_;
  bool is_settled_ = false;
  int code_ = static_cast<int>(ExitCode::done);  ///< that has been agreed
  std::shared_ptr<const mpi::Communicator> ranks_;
};

}  // namespace

std::unique_ptr<RankJob> join_ranks(int argc, const char* const* argv) {
  const std::span arguments(argv, static_cast<std::size_t>(argc));
  const bool has_pieces =
      std::ranges::any_of(arguments, [](const char* argument) { return names_parallel_file(argument); });
  return has_pieces || has_launcher() ? std::make_unique<MpiJob>(has_pieces) : nullptr;
}

std::string launched_rank() {
  for (const char* const name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK"}) {
    if (const char* const rank = std::getenv(name); rank != nullptr && std::string_view(rank) != "0") {
      return std::string("rank ").append(rank).append(": ");
    }
  }
  return {};
}

std::string mpi_text() {
  return mpi_library() + "; reads meshes in pieces (.pvtu, .pvtp)" +
         (metis_version().empty() ? "" : "; partitions by METIS " + metis_version());
}

#else

std::string metis_version() {
  return {};
}

std::string launched_rank() {
  return {};
}

std::string mpi_text() {
  return "not in this build";
}

std::unique_ptr<RankJob> join_ranks(int /*argc*/, const char* const* /*argv*/) {
  return nullptr;
}

#endif

void require_partition(Partition partition) {
  if (partition == Partition::metis && metis_version().empty()) {
    throw std::invalid_argument("this build has no METIS; bisect shares the mesh out without it");
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
// The main of the test program, which runs on several ranks: all run the same tests, and the first one reports.

#include <cstdio>
#include <cstdlib>

#include <mpi.h>

#include "catch.h"
#include "mpi/watchdog.h"
#include "support/sanitized.h"

int run_catch(int argc, char** argv);

/// Why there is nothing to run, or null. Weak: programs that need something have their own.
[[gnu::weak]] const char* reason_to_skip() {
  return nullptr;
}

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (const char* const reason = reason_to_skip()) {
    constexpr int skipped = 77;
    if (rank == 0) {
      std::printf("skipped: %s\n", reason);
    }
    MPI_Finalize();
    return skipped;
  }
  // In seconds. Ranks that share cores with other programs take several times as long as on a quiet machine.
  constexpr int longest_run = is_sanitized ? 900 : 500;
  const mpi_tests::Watchdog watchdog(longest_run);
  // What a rank alone finds is on standard error.
  if (rank != 0 && std::freopen("/dev/null", "w", stdout) == nullptr) {
    std::perror("/dev/null");
  }
  int failed = run_catch(argc, argv);
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

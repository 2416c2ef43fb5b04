// SPDX-License-Identifier: BSD-3-Clause
// Preloaded in front of MPI: its end crashes, in a thread that it has not ended, as Open MPI's now and then.
#include <csignal>
#include <thread>

extern "C" int MPI_Finalize() {  // NOLINT(readability-identifier-naming): the name is MPI's
  std::thread([] { std::raise(SIGSEGV); }).join();
  return 0;
}

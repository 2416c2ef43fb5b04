#include "trismooth/pipeline/interrupt.h"

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include "trismooth/mesh_io/output_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::interrupt_requested;
using trismooth::InterruptGuard;
using trismooth::OnInterrupt;

namespace {

/// What became of a child process that ran `body`: its exit status, or minus the signal that ended it.
int outcome_of(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    body();
    ::_exit(42);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("the first signal is noted, and asked for") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const InterruptGuard guard(OnInterrupt::ask);
    CHECK_FALSE(interrupt_requested());
    std::raise(signal);
    CHECK(interrupt_requested());
  }
}

TEST_CASE("a new guard forgets the signals of the last one") {
  {
    const InterruptGuard guard(OnInterrupt::ask);
    std::raise(SIGINT);
  }
  const InterruptGuard guard(OnInterrupt::ask);
  CHECK_FALSE(interrupt_requested());
}

TEST_CASE("the second signal removes unfinished files and ends the process with 130") {
  const ScratchFolder folder;
  const int outcome = outcome_of([&] {
    const InterruptGuard guard(OnInterrupt::ask);
    const trismooth::OutputFile unfinished(folder / "mesh.off");
    std::raise(SIGINT);
    std::raise(SIGTERM);
  });
  CHECK(outcome == 130);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("where the guard is to exit, the first signal does that") {
  const ScratchFolder folder;
  const int outcome = outcome_of([&] {
    const InterruptGuard guard(OnInterrupt::exit);
    const trismooth::OutputFile unfinished(folder / "mesh.off");
    std::raise(SIGINT);
  });
  CHECK(outcome == 130);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("without a guard, signals do what they did before") {
  const int outcome = outcome_of([] {
    { const InterruptGuard guard(OnInterrupt::ask); }
    std::signal(SIGINT, SIG_DFL);
    { const InterruptGuard guard(OnInterrupt::ask); }
    std::raise(SIGINT);
  });
  CHECK(outcome == -SIGINT);
}

TEST_CASE("a signal that was ignored stays ignored") {
  const int outcome = outcome_of([] {
    std::signal(SIGINT, SIG_IGN);
    const InterruptGuard guard(OnInterrupt::ask);
    std::raise(SIGINT);
    ::_exit(interrupt_requested() ? 1 : 0);
  });
  CHECK(outcome == 0);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/interrupt.h"

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include "trismooth/mesh_io/bytes/output_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::interrupt_test {

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

/// What a child process came to that takes the signals, calls `body` and ends with 42.
int outcome_after(const std::function<void()>& body) {
  return outcome_of([&] {
    trismooth::end_on_interrupt();
    body();
  });
}

TEST_CASE("a signal removes unfinished files and ends the process with 130") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    CAPTURE(signal);
    const ScratchFolder folder;
    const int outcome = outcome_after([&] {
      const OutputFile unfinished(folder / "mesh.off");
      const OutputFile another(folder / "report.json");
      std::raise(signal);
    });
    CHECK(outcome == 130);
    CHECK(std::filesystem::is_empty(folder.path()));
  }
}

TEST_CASE("once a file is put in its place, a signal changes nothing, and a second one ends the process") {
  for (const int signals : {0, 1, 2}) {
    CAPTURE(signals);
    const ScratchFolder folder;
    const int outcome = outcome_after([&] {
      OutputFile finished(folder / "mesh.off");
      finished.commit();
      const OutputFile unfinished(folder / "report.json");
      for (int i = 0; i < signals; ++i) {
        std::raise(i == 0 ? SIGINT : SIGTERM);
      }
    });
    CHECK(outcome == (signals == 2 ? 130 : 42));
    CHECK(std::filesystem::exists(folder / "mesh.off"));
    CHECK(folder.size() == 1);
  }
}

TEST_CASE(
    "a run that goes on to another mesh ends between the two where a signal came while one was put in its place") {
  for (const bool is_interrupted : {false, true}) {
    CAPTURE(is_interrupted);
    const ScratchFolder folder;
    const int outcome = outcome_after([&] {
      trismooth::end_where_interrupted();
      OutputFile(folder / "first.off").commit();
      if (is_interrupted) {
        std::raise(SIGTERM);
      }
      trismooth::end_where_interrupted();
      OutputFile(folder / "second.off").commit();
    });
    CHECK(outcome == (is_interrupted ? 130 : 42));
    CHECK(folder.size() == (is_interrupted ? 1 : 2));
  }
}

TEST_CASE("what was put in its place before the signals were taken does not count") {
  const ScratchFolder folder;
  const int outcome = outcome_of([&] {
    OutputFile(folder / "earlier.off").commit();
    trismooth::end_on_interrupt();
    std::raise(SIGINT);
  });
  CHECK(outcome == 130);
}

TEST_CASE("a signal that was ignored stays ignored") {
  for (const int signal : {SIGINT, SIGHUP}) {
    const int outcome = outcome_of([&] {
      std::signal(signal, SIG_IGN);
      trismooth::end_on_interrupt();
      std::raise(signal);
    });
    CHECK(outcome == 42);
  }
}

}  // namespace trismooth::interrupt_test

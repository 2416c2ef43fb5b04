// SPDX-License-Identifier: BSD-3-Clause
// A rank of a job that lasts: it runs the program whenever the test says so, for MPI takes longer to begin and to end
// than most runs do.
//
//     lasting_rank SOCKET STDOUT STDERR
//
// A line from the socket is a run: NAME=VALUE for the environment, the folder and the program's words, with tabs
// between them. The answer is a line with the exit code.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <mpi.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "trismooth/paper/bench_command.h"
#include "trismooth/pipeline/cli/command_line.h"

// What a run calls: MPI itself begins and ends in main().
// NOLINTBEGIN(readability-identifier-naming): the names are MPI's
extern "C" int MPI_Init_thread(int* /*argc*/, char*** /*argv*/, int /*required*/, int* provided) {
  *provided = MPI_THREAD_FUNNELED;
  return MPI_SUCCESS;
}
extern "C" int MPI_Finalize() {
  return MPI_Barrier(MPI_COMM_WORLD);
}
// NOLINTEND(readability-identifier-naming)

namespace {

[[noreturn]] void fail(const char* what) {
  std::perror(what);
  std::exit(EXIT_FAILURE);
}

std::FILE* connected(const char* path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path, sizeof(address.sun_path) - 1);
  const int test = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (test < 0 || ::connect(test, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    fail(path);
  }
  return ::fdopen(test, "r");
}

/// Has a standard stream go to the end of a file, past the launcher, which may be late with it.
void redirect(int stream, const char* path) {
  const int file = ::open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0 || ::dup2(file, stream) < 0) {
    fail(path);
  }
}

/// Tells failing_new.cpp, where that is preloaded, of the environment of a run, and that the run is over.
void tell_of_run() {
  if (void* const told = ::dlsym(RTLD_DEFAULT, "trismooth_plan_failures")) {
    reinterpret_cast<void (*)()>(told)();
  }
}

int run(char* line) {
  line[std::strcspn(line, "\n")] = '\0';
  std::vector<const char*> words;
  while (char* word = ::strsep(&line, "\t")) {
    if (words.empty() && *word != '/') {
      const char* const name = ::strsep(&word, "=");
      ::setenv(name, word, 1);
    } else {
      words.push_back(word);
    }
  }
  if (::chdir(words.front()) != 0) {
    fail(words.front());
  }
  words.front() = "trismooth";
  // As in a process of its own: the run before has them ignored.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);
  }
  tell_of_run();
  const int code =
      trismooth::run_program(static_cast<int>(words.size()), words.data(), {&trismooth::add_bench_command});
  std::cout.flush();
  tell_of_run();
  return code;
}

}  // namespace

int main(int /*argc*/, char** argv) {
  int provided = 0;
  PMPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  std::FILE* const test = connected(argv[1]);
  redirect(STDOUT_FILENO, argv[2]);
  redirect(STDERR_FILENO, argv[3]);
  char* line = nullptr;
  for (std::size_t room = 0; ::getline(&line, &room, test) > 0;) {
    ::dprintf(::fileno(test), "%d\n", run(line));
  }
  std::free(line);
  PMPI_Finalize();
  return EXIT_SUCCESS;
}

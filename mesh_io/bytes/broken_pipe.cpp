// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/broken_pipe.h"

#include <cerrno>
#include <cstddef>
#include <ctime>

#include <unistd.h>

namespace trismooth {

namespace {

sigset_t broken_pipe_signal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGPIPE);
  return signals;
}

}  // namespace

BrokenPipeIsError::BrokenPipeIsError() {
  const sigset_t signals = broken_pipe_signal();
  ::pthread_sigmask(SIG_BLOCK, &signals, &signals_before_);
}

BrokenPipeIsError::~BrokenPipeIsError() {
  const int error = errno;  // of the write
  if (sigismember(&signals_before_, SIGPIPE) == 0) {
    const sigset_t signals = broken_pipe_signal();
    constexpr timespec no_time{};
    ::sigtimedwait(&signals, nullptr, &no_time);  // one that is pending is of our writes
    ::pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
  }
  errno = error;
}

bool write_to_descriptor(int descriptor, std::string_view bytes) {
  const BrokenPipeIsError this_thread;
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace trismooth

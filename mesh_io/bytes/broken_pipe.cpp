#include "trismooth/mesh_io/bytes/broken_pipe.h"

#include <ctime>

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
  if (sigismember(&signals_before_, SIGPIPE) == 0) {
    const sigset_t signals = broken_pipe_signal();
    constexpr timespec no_time{};
    ::sigtimedwait(&signals, nullptr, &no_time);  // one that is pending is of our writes
    ::pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
  }
}

}  // namespace trismooth

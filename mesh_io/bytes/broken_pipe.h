#pragma once

#include <csignal>

namespace trismooth {

/// As long as it lives, a write of this thread to a pipe that nobody reads any more is an error (EPIPE), not a SIGPIPE,
/// which would end the program. To be destroyed by the thread that made it.
class BrokenPipeIsError {
 public:
  BrokenPipeIsError();
  BrokenPipeIsError(const BrokenPipeIsError&) = delete;
  BrokenPipeIsError& operator=(const BrokenPipeIsError&) = delete;
  ~BrokenPipeIsError();

 private:
  sigset_t signals_before_{};
};

}  // namespace trismooth

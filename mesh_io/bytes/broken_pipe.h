// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <string_view>

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

/// Writes all of that to an open descriptor. False, with errno, where it cannot; a pipe that nobody reads any more is
/// an error. Any thread may call it.
bool write_to_descriptor(int descriptor, std::string_view bytes);

}  // namespace trismooth

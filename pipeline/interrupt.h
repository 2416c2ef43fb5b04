#pragma once

#include <array>
#include <csignal>
#include <cstdint>

namespace trismooth {

/// What the first SIGINT (Ctrl-C) or SIGTERM does.
enum class OnInterrupt : std::uint8_t {
  ask,   ///< interrupt_requested() answers true from then on; a second signal acts as `exit` does
  exit,  ///< unfinished output files are removed and the process says so and ends with status 130
};

/// Catches SIGINT and SIGTERM while it lives; the destructor puts the handlers back that were there before. A signal
/// that was ignored (a job in the background of a script) stays ignored. One at a time in a process.
class InterruptGuard {
 public:
  explicit InterruptGuard(OnInterrupt action);
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

 private:
  std::array<struct sigaction, 2> previous_{};
};

/// True where a signal arrived since the last InterruptGuard was made. For callbacks that can stop a run.
bool interrupt_requested() noexcept;

}  // namespace trismooth

#include "trismooth/pipeline/interrupt.h"

#include <atomic>
#include <string_view>

#include <unistd.h>

#include "trismooth/mesh_io/output_file.h"
#include "trismooth/pipeline/exit_code.h"

namespace trismooth {

namespace {

constexpr std::array<int, 2> caught_signals{SIGINT, SIGTERM};

// All that the handler touches. Lock-free, or a handler could wait for the code that it interrupted.
std::atomic<bool> requested{false};
std::atomic<bool> exit_at_once{false};
std::atomic<bool> on_terminal{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// Over the line of a terminal on which progress may stand (ECMA-48 EL), or on a line of its own.
constexpr std::string_view terminal_farewell = "\r\x1b[Ktrismooth: error: cancelled\n";
constexpr std::string_view farewell = "trismooth: error: cancelled\n";

extern "C" void handle_interrupt(int /*signal*/) {
  if (requested.exchange(true) || exit_at_once) {
    OutputFile::remove_unfinished();
    const std::string_view words = on_terminal ? terminal_farewell : farewell;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words.data(), words.size());
    _exit(static_cast<int>(ExitCode::cancelled));
  }
}

}  // namespace

InterruptGuard::InterruptGuard(OnInterrupt action) {
  requested = false;
  exit_at_once = action == OnInterrupt::exit;
  on_terminal = ::isatty(STDERR_FILENO) != 0;
  for (std::size_t i = 0; i < caught_signals.size(); ++i) {
    ::sigaction(caught_signals[i], nullptr, &previous_[i]);
    if (previous_[i].sa_handler == SIG_IGN) {
      continue;
    }
    struct sigaction action_now {};
    action_now.sa_handler = &handle_interrupt;
    sigemptyset(&action_now.sa_mask);
    // Reads and writes under way go on: nobody but the callbacks looks at the flag.
    action_now.sa_flags = SA_RESTART;
    ::sigaction(caught_signals[i], &action_now, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < caught_signals.size(); ++i) {
    ::sigaction(caught_signals[i], &previous_[i], nullptr);
  }
}

bool interrupt_requested() noexcept {
  return requested;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/interrupt.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <string_view>

#include <unistd.h>

#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/pipeline/cli/exit_code.h"
#include "trismooth/pipeline/cli/terminal_line.h"

namespace trismooth {

namespace {

constexpr std::array<int, 3> caught_signals{SIGINT, SIGTERM, SIGHUP};

// All that the handler touches. Lock-free, or a handler could wait for the code that it interrupted.
std::atomic<std::uint64_t> commits_at_start{0};
std::atomic<bool> on_terminal{false};
std::atomic<bool> is_silent{false};
std::atomic<bool> came_too_late{false};
std::atomic<bool> leaving{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

void leave(std::string_view words) {
  // In one piece, or the clock of the progress could come in between.
  std::array<char, 128> text{};
  const std::string_view first = on_terminal ? clear_line : std::string_view();
  std::copy(words.begin(), words.end(), std::copy(first.begin(), first.end(), text.begin()));
  if (!is_silent) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), first.size() + words.size());
  }
  _exit(static_cast<int>(ExitCode::cancelled));
}

void leave_with_some_written() {
  OutputFile::remove_unfinished();
  leave("trismooth: error: cancelled; some of the output is written already\n");
}

extern "C" void handle_interrupt(int /*signal*/) {
  if (leaving) {
    return;  // another thread is at it
  }
  if (OutputFile::give_up(commits_at_start)) {
    leaving = true;
    leave("trismooth: error: cancelled\n");
  }
  if (came_too_late.exchange(true) && !leaving.exchange(true)) {
    leave_with_some_written();
  }
}

}  // namespace

void end_on_interrupt(InterruptWords words) {
  is_silent = words == InterruptWords::none;
  commits_at_start = OutputFile::commits_begun();
  on_terminal = ::isatty(STDERR_FILENO) != 0;
  struct sigaction action {};
  action.sa_handler = &handle_interrupt;
  sigemptyset(&action.sa_mask);
  for (const int signal : caught_signals) {
    sigaddset(&action.sa_mask, signal);
  }
  // Reads and writes under way go on where the signal comes too late.
  action.sa_flags = SA_RESTART;
  for (const int signal : caught_signals) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) {
      ::sigaction(signal, &action, nullptr);
    }
  }
}

void end_where_interrupted() {
  if (came_too_late && !leaving.exchange(true)) {
    leave_with_some_written();
  }
}

void ignore_interrupts() {
  for (const int signal : caught_signals) {
    std::signal(signal, SIG_IGN);
  }
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/ticker.h"

#include <csignal>
#include <system_error>
#include <utility>

namespace trismooth {

Ticker::Ticker(std::chrono::milliseconds interval, std::function<void()> tick) : tick_(std::move(tick)) {
  // The thread takes over which signals are blocked: an interrupt goes to the threads that work.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    thread_ = std::thread([this, interval] { run(interval); });
  } catch (const std::system_error&) {
    // A display that stands still is better than no result.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Ticker::~Ticker() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Ticker::run(std::chrono::milliseconds interval) {
  std::unique_lock lock(mutex_);
  // By the system's clock, for the thread sanitizer of Clang 14 does not know how to wait by the steady one. If it is
  // set back, the next call comes late.
  while (!stopped_.wait_until(lock, std::chrono::system_clock::now() + interval, [this] { return stops_; })) {
    lock.unlock();
    try {
      tick_();
    } catch (...) {
      // Nobody could be told; the next one may succeed.
    }
    lock.lock();
  }
}

}  // namespace trismooth
